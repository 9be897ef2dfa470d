-- Near-horizontal edges that drift at 30 scan lines a second (section 5 of the paper): in one
-- field period an edge goes half a line, in a frame one line, so that on an interlaced display
-- each field shows it where the other's lines are. Narrow apertures make the edges crawl.
--
--   weft render slow_edges.lua --aperture line -o crawl.y4m
--   weft render slow_edges.lua --aperture shaped -o calm.y4m

local lines = raster.lines
local drift = param.drift or 30 -- scan lines a second

duration(4)
background(0.02)
camera{eye={0, 0, lines}, look_at={0, 0, 0}, ortho_height=lines}

-- Bars of a quarter of the picture's width, each a little steeper than the one before.
local width = raster.width * raster.pixel_aspect / 4
for n = 0, 3 do
    local slope = ({0, 0.01, 0.03, 0.1})[n + 1]
    local column = box{min={-width / 2 + 4, -lines, -1}, max={width / 2 - 4, lines, 1}}
    local bars = {}
    for k = -8, 8 do
        local low = halfspace{normal={slope, -1, 0}, offset=-k * lines / 6}
        local high = halfspace{normal={-slope, 1, 0}, offset=k * lines / 6 + lines / 12}
        bars[#bars + 1] = (low * high):velocity{0, -drift, 0}
    end
    add((union(bars) * column):translate{(n - 1.5) * width, 0, 0}
        :material{unlit=true, color=({{0.8, 0.8, 0.8}, {0.8, 0.75, 0.2}, {0.3, 0.7, 0.8},
                                      {0.75, 0.3, 0.25}})[n + 1]})
end
