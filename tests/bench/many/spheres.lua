-- Spheres in a cloud over a floor, smaller as they are more, so that they cover as much of the
-- picture: --set n=100000, --set reflect=0.5 for mirrors, refract=0.5 for glass.
local count = param.n or 1000
local look = {reflect=param.reflect or 0, refract=param.refract or 0}
depth(param.depth or 1)
camera{eye={0, 5, 13}, look_at={0, 0.4, 0}, fov=42}
light{point={8, 14, 9}, color=0.8}
background{0.2, 0.3, 0.5}
add(halfspace{normal={0, 1, 0}, offset=-1}:material{texture=checker{0.8, 0.2}})
local function within(low, high) return low + (high - low) * math.random() end
local largest = 2.7 * count ^ (-1 / 3)
for n = 1, count do
    local ball = sphere{center={within(-6, 6), within(-1, 2), within(-8, 4)},
                        radius=largest * within(0.3, 1)}
    look.color = {math.random(), math.random(), math.random()}
    add(ball:material(look))
end
