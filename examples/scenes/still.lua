-- A scene in which nothing moves: it costs the same at any temporal width, and every field of
-- one parity is the same as the one before it.
--
--   weft render still.lua --frames 0 -o still.#.png

duration(2)
background{0.5, 0.6, 0.75}
camera{eye={0.5, 3.2, 9}, look_at={0, 1.1, 0}, fov=34}
light{point={6, 10, 7}, color={1, 0.96, 0.9}}
light{direction={1, -1, -1}, color=0.15, shadows=false}

local table_top = box{min={-3.4, 0.75, -1.6}, max={3.4, 0.95, 1.6}}
local legs = {}
for x = -3, 3, 6 do
    for z = -1.2, 1.2, 2.4 do
        legs[#legs + 1] = cone{from={x, 0, z}, to={x, 0.75, z}, radii={0.09, 0.16}}
    end
end
add(union(table_top, union(legs)):material{color={0.45, 0.27, 0.14}, specular=0.2})

-- A bowl: a sphere cut off and hollowed out. A die: a box and a sphere, with pips taken out.
local bowl = (sphere{center={0, 1.75, 0}, radius=0.8} - sphere{center={0, 1.75, 0}, radius=0.72}) *
             halfspace{normal={0, 1, 0}, offset=1.75}
add((bowl + torus{center={0, 1.75, 0}, major=0.76, minor=0.05} +
     cylinder{from={0, 0.95, 0}, to={0, 1.02, 0}, radius=0.4})
    :material{color={0.2, 0.42, 0.6}, specular=0.6, shininess=80})
for k = 0, 4 do
    local a = k * 2 * math.pi / 5
    add(sphere{center={0.36 * math.cos(a), 1.55, 0.36 * math.sin(a)}, radius=0.24}
        :material{color={0.8, 0.5 - 0.06 * k, 0.08}, specular=0.2})
end
local die = box{min={-0.5, -0.5, -0.5}, max={0.5, 0.5, 0.5}} * sphere{radius=0.72}
local pips = {}
for _, p in ipairs{{0.25, 0.25}, {-0.25, -0.25}, {0, 0}, {0.25, -0.25}, {-0.25, 0.25}} do
    pips[#pips + 1] = sphere{center={p[1], p[2], 0.54}, radius=0.1}
    pips[#pips + 1] = sphere{center={p[1], 0.54, p[2]}, radius=0.1}
end
add((die - union(pips)):rotate{degrees=28}:translate{-1.9, 1.45, 0.4}
    :material{color={0.85, 0.83, 0.78}, specular=0.4})
add(cone{from={1.9, 0.95, 0.2}, to={1.9, 2.3, 0.2}, radii={0.55, 0}}
    :material{texture=checker{{0.75, 0.2, 0.15}, {0.9, 0.85, 0.75}, size=0.25}})
add(halfspace{normal={0, 1, 0}}:material{texture=checker{{0.5, 0.48, 0.45}, {0.36, 0.34, 0.33}}})
