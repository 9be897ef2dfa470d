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
    local half = width / 2
    local bar = polyhedron{planes={{slope, 1, 0, 0}, {-slope, -1, 0, 6 * lines}, {1, 0, 0, half},
                                   {-1, 0, 0, half}, {0, 0, 1, 1}, {0, 0, -1, 1}}}
    add(bar:translate{(n - (columns - 1) / 2) * width, lines / 4 + 0.21, 0}:velocity{0, -speed, 0}
        :material{unlit=true, color=0.8})
end
