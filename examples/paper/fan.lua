-- Thin bars side by side that cross the middle of the picture together, each at its own speed, up to
-- 60 lines a second either way. In (t, y) every speed is a slanted line, and so is its spectrum.

local lines, seconds = raster.lines, param.seconds or 1
local columns = param.columns or 9

duration(seconds)
camera{eye={0, 0, 9}, look_at={0, 0, 0}, ortho_height=lines}
local width = raster.width * raster.pixel_aspect / columns
for n = 0, columns - 1 do
    local speed = columns > 1 and -60 + 120 * n / (columns - 1) or param.speed or 30
    add(box{min={-width / 2, -0.5, -1}, max={width / 2, 0.5, 1}}:material{unlit=true, color=1}
        :translate{(n - (columns - 1) / 2) * width, speed * seconds / 2, 0}:velocity{0, -speed, 0})
end
