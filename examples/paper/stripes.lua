-- For the player: slanted bars that sink one line a frame and are back where they were after `period`
-- frames, half of them still.

local lines, period = raster.lines, param.period or 16
local slopes = {0, 0.03, 0.08, 0.25}
local width = raster.width * raster.pixel_aspect / #slopes

duration(4)
background(0.03)
camera{eye={0, 0, lines}, look_at={0, 0, 0}, ortho_height=lines}
for n, slope in ipairs(slopes) do
    local bars = {}
    for k = -lines // period - 2, lines // period + 4 do
        local low = halfspace{normal={slope, -1, 0}, offset=-k * period}
        local high = halfspace{normal={-slope, 1, 0}, offset=k * period + period / 2}
        bars[#bars + 1] = (low * high):velocity{0, -raster.frame_rate, 0}
    end
    local column = box{min={-width / 2 + 2, -9 * lines, -1}, max={width / 2 - 2, 9 * lines, 1}}
    add((union(bars) * column):translate{(n - 2.5) * width, 0, 0}:material{unlit=true, color=0.8})
end
