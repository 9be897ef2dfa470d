-- Thin spokes at 900 rpm before a lit wall: each is in any one cell for a moment only.
camera{eye={0, 0, 12}, look_at={0, 0, 0}, fov=36}
background{.02, .02, .03}
light{point={5, 7, 10}}
add(box{min={-8, -8, -2}, max={8, 8, -1.5}}:material{color={.25, .3, .45}})
local spokes = {}
for i = 0, 4 do
    spokes[#spokes + 1] = cylinder{from={0, 0, 0}, to={3.2, 0, 0}, radius=.02}:rotate{axis={0, 0, 1}, degrees=72*i}
end
add(union(table.unpack(spokes)):spin{axis={0, 0, 1}, rpm=900}:material{color={.95, .9, .7}, specular=.4})
add(torus{center={0, 0, 0}, axis={0, 0, 1}, major=3.3, minor=.06}:material{color={.8, .2, .1}})
duration(10)
