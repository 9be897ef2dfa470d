-- Graphics of a broadcast: a table with hairlines, bars, a clock's hands and a slanted curve, colors at the gamut's
-- edge.
local lines = raster.lines
local u = lines / 100
duration(4)
camera{eye={0, 0, lines}, look_at={0, 0, 0}, ortho_height=lines}
background{0.01, 0.02, 0.12}
local colors = {{0.9, 0.05, 0.04}, {0.02, 0.6, 0.1}, {0.95, 0.85, 0.05}, {0.1, 0.25, 0.9}, {0.9, 0.9, 0.9}}

local function plate(x0, y0, x1, y1, z, color)
    add(box{min={x0 * u, y0 * u, z}, max={x1 * u, y1 * u, z + 0.1}}:material{unlit=true, color=color})
end

plate(-58, -36, 4, 36, 0, {0.05, 0.09, 0.3})
for k = 0, 12 do -- rows parted by lines of 1/2 to 2 scan lines
    local y = -34 * u + k * 5.6 * u
    add(box{min={-56 * u, y, 1}, max={2 * u, y + 0.5 + k % 4 / 2, 1.1}}:material{unlit=true, color=0.7})
    for column = 0, 3 do
        local long = 2 + math.random(9)
        plate(-55 + 14 * column, -33 + 5.6 * k, -55 + 14 * column + long, -33 + 5.6 * k + 2.1, 2, colors[1 + (k + column) % 5])
    end
end
for k = 0, 11 do -- a clock
    add(box{min={-0.35 * u, 17 * u, 1}, max={0.35 * u, 20 * u, 1.1}}:rotate{axis={0, 0, 1}, degrees=30 * k}
        :translate{32 * u, 12 * u, 0}:material{unlit=true, color=0.9})
end
for _, hand in ipairs{{12, 0.5, 97}, {17, 0.35, 186}, {18, 0.12, 83}} do
    add(box{min={-hand[2] * u, -3 * u, 2}, max={hand[2] * u, hand[1] * u, 2.1}}
        :rotate{axis={0, 0, 1}, degrees=hand[3]}:translate{32 * u, 12 * u, 0}:material{unlit=true, color={1, 0.9, 0.2}})
end
for k = 0, 11 do -- a curve of nearly level pieces
    local slope = 6 * math.sin(k * 1.1)
    add(box{min={-2.2 * u, -0.9, 1}, max={2.2 * u, 0.9, 1.1}}:rotate{axis={0, 0, 1}, degrees=slope}
        :translate{(10 + 4.1 * k) * u, (-26 + 0.5 * math.sin(k)) * u, 0}:material{unlit=true, color={0.1, 0.9, 0.5}})
end
