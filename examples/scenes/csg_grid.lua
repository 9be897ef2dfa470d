-- Very many solids, of which few stand over any one place of the picture: `--set n=N` of them
-- (10,000), spheres with a bite taken out, in a grid. What a tile cannot see costs it nothing.
--
--   weft render csg_grid.lua --set n=100000 --frames 0 -o grid.#.png

local n = math.floor(param.n or 10000)
local across = math.ceil(math.sqrt(n * 4 / 3))
local down = math.ceil(n / across)
local colors = {{0.8, 0.25, 0.2}, {0.25, 0.6, 0.3}, {0.2, 0.35, 0.75}, {0.8, 0.65, 0.2}}

duration(1)
background(0.05)
camera{eye={across / 2, -down / 2, 100}, look_at={across / 2, -down / 2, 0},
       ortho_height=down * 1.02}
light{direction={-1, -1, -2}, shadows=false}

local bitten = {}
for k, color in ipairs(colors) do
    bitten[k] = (sphere{radius=0.42} - sphere{center={0.25, 0.25, 0.4}, radius=0.3})
        :material{color=color, specular=0.3}
end
for k = 0, n - 1 do
    local i, j = k % across, k // across
    add(bitten[(i + 2 * j) % 4 + 1]:translate{i + 0.5, -j - 0.5, 0})
end
