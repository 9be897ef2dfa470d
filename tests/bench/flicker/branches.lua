-- A bare tree before the sky: hundreds of twigs at every angle, down to a quarter of a scan line.
duration(4)
camera{eye={0, 0, 10}, look_at={0, 2.4, 0}, fov=36}
background{0.72, 0.78, 0.86}
light{point={6, 8, 9}}
add(halfspace{normal={0, 1, 0}, offset=-1.2}:material{color={0.3, 0.27, 0.2}})
local bark = {color={0.13, 0.1, 0.08}}

local function grow(x, y, z, angle, lean, length, radius, depth)
    local dx = length * math.sin(angle)
    local dy, dz = length * math.cos(angle), length * lean
    add(cone{from={x, y, z}, to={x + dx, y + dy, z + dz}, radii={radius, 0.68 * radius}}:material(bark))
    if depth == 0 then return end
    for _ = 1, 2 + math.random(2) // 2 do
        grow(x + dx, y + dy, z + dz, angle + (math.random() - 0.5) * 1.5, (math.random() - 0.5) * 0.7,
             length * (0.66 + 0.2 * math.random()), 0.66 * radius, depth - 1)
    end
end

grow(-0.2, -1.2, 0, 0.05, 0, 1.5, 0.12, 7)
