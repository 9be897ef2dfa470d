-- Nearly horizontal edges side by side, each sinking at its own speed: from= to to= scan lines a
-- second; or all at drift=. Dark above, light below.

local lines, columns = raster.lines, param.columns or 13
local first, last = param.from or 0, param.to or 120
local width = raster.width * raster.pixel_aspect / columns

duration(4)
camera{eye={0, 0, lines}, look_at={0, 0, 0}, ortho_height=lines}
for n = 0, columns - 1 do
    local speed = param.drift or first + (last - first) * n / (columns - 1)
    local slope = (param.rise or 2) / width -- lines over the column
    local bar = halfspace{normal={slope, 1, 0}} * halfspace{normal={-slope, -1, 0}, offset=6 * lines} *
                halfspace{normal={0, 0, 1}, offset=1}
    local column = box{min={-width / 2, -9 * lines, -2}, max={width / 2, 9 * lines, 2}}
    add((bar:translate{0, lines / 4 + 0.21, 0}:velocity{0, -speed, 0} * column)
        :translate{(n - (columns - 1) / 2) * width, 0, 0}:material{unlit=true, color=0.8})
end
