-- Spheres far smaller than a pixel, n of them, lit and drifting before a dark ground: most cells
-- hold something that few samples see.
local n = param.n or 4000
camera{eye={0, 0, 20}, look_at={0, 0, 0}, fov=40}
background{.01, .012, .02}
light{direction={-1, -2, -3}}
for i = 1, n do
    local p = {math.random()*22 - 11, math.random()*16 - 8, math.random()*6 - 3}
    add(sphere{center=p, radius=.02 + .03*math.random()}
        :material{color={.5 + .5*math.random(), .4 + .5*math.random(), .9}}
        :velocity{.6*math.random() - .3, .6*math.random() - .3, 0})
end
duration(10)
