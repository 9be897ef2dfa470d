camera{eye={0, 3, 9}, look_at={0, 1, 0}}
light{point={5, 9, 6}}
background{0.2, 0.3, 0.5}
add(halfspace{normal={0, 1, 0}}:material{texture=checker{1, 0.2}})
local a, b = box{min={-1, 0, -1}, max={1, 2, 1}}, sphere{center={0, 1, 0}, radius=1.3}
add((a - b):spin{rpm=60}:material{color={1, 0.3, 0.2}, reflect=0.3})
add((a * b):translate{3, 0, 0}:velocity{-4, 0, 0})
add((a + b):scale(0.5):translate{-3, 0, 1}:spin{rpm=33, center={-3, 0, 0}})
add(torus{center={0, 2.6, 0}, major=0.7, minor=0.2}:keyframes{{time=0}, {time=1, degrees=90, axis={1, 0, 0}}})
add(cone{from={2, 0, 2}, to={2, 1, 2}, radii={0.5, 0}}:material{refract=0.8, color=1})
