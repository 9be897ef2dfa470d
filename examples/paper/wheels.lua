-- A grid of wheels with eight spokes, each at its own speed: from= to to= turns a minute.

local across, down = param.across or 6, param.down or 4
local first, last = param.from or 0, param.to or 900
local cell = raster.lines / down

duration(1)
camera{eye={0, 0, 99}, look_at={0, 0, 0}, ortho_height=raster.lines}
for n = 0, across * down - 1 do
    local spokes = {}
    for k = 0, 3 do
        spokes[k + 1] = box{min={-0.42 * cell, -1.5, -1}, max={0.42 * cell, 1.5, 1}}
            :rotate{axis={0, 0, 1}, degrees=45 * k}
    end
    local rpm = first + (last - first) * n / (across * down - 1)
    add(union(spokes):material{unlit=true, color=0.9}:spin{axis={0, 0, 1}, rpm=rpm}
        :translate{(n % across - (across - 1) / 2) * cell, ((down - 1) / 2 - n // across) * cell, 0})
end
