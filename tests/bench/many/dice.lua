-- Dice with three holes each, in rows on a floor: set operations.
camera{eye={0, 7, 14}, look_at={0, 0, 0}, fov=40}
light{point={8, 14, 9}, color=0.8}
background{0.2, 0.3, 0.5}
add(halfspace{normal={0, 1, 0}, offset=-1}:material{texture=checker{0.8, 0.2}})
for x = -4, 4 do
    for z = -4, 4 do
        local die = box{min={-0.6, -0.6, -0.6}, max={0.6, 0.6, 0.6}} * sphere{radius=0.82}
        die = die - cylinder{from={-1, 0, 0}, to={1, 0, 0}, radius=0.35}
            - cylinder{from={0, -1, 0}, to={0, 1, 0}, radius=0.35}
            - cylinder{from={0, 0, -1}, to={0, 0, 1}, radius=0.35}
        add(die:material{color={0.5 + x / 10, 0.5 + z / 10, 0.5}}
            :rotate{axis={1, 1, 0}, degrees=(9 * x + z) * 20}:translate{1.5 * x, 0, 1.5 * z})
    end
end
