-- What a poor character generator makes: still lettering of sharp strokes, slants, hairlines one scan
-- line high and a rule that is not quite level.

local lines = raster.lines
local unit = lines / 40

camera{eye={0, 0, lines}, look_at={0, 0, 0}, ortho_height=lines}
background{0.02, 0.03, 0.09}
local paper = {unlit=true, color={0.85, 0.83, 0.74}}
local gold = {unlit=true, color={0.8, 0.5, 0.08}}

local function bar(x0, y0, x1, y1, thick) -- from one point to another, in units
    local dx, dy = x1 - x0, y1 - y0
    local length = math.sqrt(dx * dx + dy * dy)
    return box{min={0, -thick / 2, 0}, max={length, thick / 2, 1}}
        :rotate{axis={0, 0, 1}, degrees=math.deg(math.atan(dy, dx))}:translate{x0, y0, 0}
end

local letters = {
    W = {{0, 7, 1.6, 0}, {1.6, 0, 3, 5}, {3, 5, 4.4, 0}, {4.4, 0, 6, 7}},
    E = {{0.4, 0, 0.4, 7}, {0, 6.6, 4, 6.6}, {0, 3.6, 3.4, 3.6}, {0, 0.4, 4, 0.4}},
    F = {{0.4, 0, 0.4, 7}, {0, 6.6, 4, 6.6}, {0, 3.6, 3.4, 3.6}},
    T = {{0, 6.6, 5, 6.6}, {2.5, 0, 2.5, 7}},
    V = {{0, 7, 2.4, 0}, {2.4, 0, 4.8, 7}}, N = {{0.4, 0, 0.4, 7}, {0.4, 7, 4, 0}, {4, 0, 4, 7}},
    S = {{0.2, 6.6, 4, 6.6}, {0.5, 3.6, 0.5, 6.6}, {0.2, 3.6, 4, 3.6}, {3.7, 0.4, 3.7, 3.6},
         {0, 0.4, 4, 0.4}},
    A = {{0, 0, 2.5, 7}, {2.5, 7, 5, 0}, {1, 2.4, 4, 2.4}},
}
local advance = {W=7, E=5, F=4.8, T=5.8, V=5.6, N=5.4, S=5, A=6}

local function write(word, x, y, size, thick, look)
    for letter in word:gmatch(".") do
        for _, s in ipairs(letters[letter] or {}) do
            local stroke = bar(s[1], s[2], s[3], s[4], thick):scale{size, size, 1}
            add(stroke:translate{x, y, 0}:material(look))
        end
        x = x + (advance[letter] or 4) * size
    end
end

write("NEWS AT TEN", -24 * unit, 4 * unit, 0.72 * unit, 0.62, paper)
write("STEVE WEST", -24 * unit, -6.5 * unit, 0.5 * unit, 0.42, gold)
add(bar(-24 * unit, 1.6 * unit, 18 * unit, 2.3 * unit, 1.2):material(paper))
for k = 0, 7 do -- hairlines
    local y = -11 * unit - 4.3 * k
    add(box{min={-24 * unit, y, 0}, max={(18 - 2 * k) * unit, y + 1, 1}}:material(gold))
end
