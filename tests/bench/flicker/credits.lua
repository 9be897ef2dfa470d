-- Credits: columns of small words that roll up, of strokes a line or two thick, white on a dark picture.
local lines = raster.lines
local speed = param.speed or 60 -- scan lines a second

duration(4)
camera{eye={0, 0, lines}, look_at={0, 0, 0}, ortho_height=lines}
background(0.012)
local look = {unlit=true, color=0.88}

local strokes = { -- of a letter in a cell 5 wide and 7 high
    {{0, 0, 0, 7}, {0, 7, 4, 7}, {0, 3.5, 3, 3.5}, {0, 0, 4, 0}}, {{0, 0, 0, 7}, {0, 7, 4, 7}, {0, 3.5, 3, 3.5}},
    {{0, 0, 2, 7}, {2, 7, 4, 0}, {1, 3, 3, 3}}, {{0, 7, 4, 7}, {2, 7, 2, 0}},
    {{0, 0, 0, 7}, {4, 0, 4, 7}, {0, 3.5, 4, 3.5}}, {{0, 7, 0, 0}, {0, 0, 4, 0}}, {{0, 0, 0, 7}, {0, 7, 4, 0}, {4, 0, 4, 7}}}

local function stroke(s, x, y, size, thick)
    local dx, dy = s[3] - s[1], s[4] - s[2]
    local length = math.sqrt(dx * dx + dy * dy)
    return box{min={-thick / 2, -thick / 2, 0}, max={length + thick / 2, thick / 2, 1}}
        :rotate{axis={0, 0, 1}, degrees=math.deg(math.atan(dy, dx))}:translate{s[1], s[2], 0}
        :scale{size, size, 1}:translate{x, y, 0}
end

for row = -8, 8 do
    local size = row % 3 == 0 and 1.9 or 1.3
    for column = 0, 1 do
        local x = column == 0 and -raster.width * 0.36 or raster.width * 0.04
        for _ = 1, 5 + math.random(5) do
            for _, s in ipairs(strokes[math.random(#strokes)]) do
                add(stroke(s, x, row * 24, size, 0.75):material(look):velocity{0, speed, 0})
            end
            x = x + 6.4 * size
        end
    end
end
