-- A house: clapboards and roof tiles in perspective, blinds, a fence. Level lines of every fineness under one sun.
duration(4)
camera{eye={5, 2.2, 11}, look_at={-0.5, 2.1, 0}, fov=34}
background{0.45, 0.62, 0.85}
light{direction={-1, -1.4, -0.9}, color={1, 0.96, 0.88}}
light{direction={1, -0.4, -1}, color=0.2, shadows=false}
add(halfspace{normal={0, 1, 0}}:material{color={0.22, 0.33, 0.14}})

for k = 0, 31 do -- boards lean out at their lower edges
    local y = 0.12 * k
    add(polyhedron{planes={{0, 0.12, 1, 0.12 * (y + 0.12)}, {0, -1, 0, -y}, {0, 1, 0, y + 0.125}, {0, 0, -1, 1},
                           {1, 0, 0, 4}, {-1, 0, 0, 4}}}:material{color={0.82, 0.8, 0.74}})
end
add(box{min={-4, 0, -4}, max={4, 3.84, -0.1}}:material{color={0.7, 0.68, 0.62}})
for k = 0, 23 do -- tiles in courses
    local at = k / 24
    add(box{min={-4.4, -0.03, 0}, max={4.4, 0.03, 0.16}}:rotate{axis={1, 0, 0}, degrees=32}
        :translate{0, 3.75 + 1.9 * at, 0.5 - 3 * at}:material{color={0.4 - 0.1 * (k % 2), 0.16, 0.1}})
end
for _, x in ipairs{-2.4, 1.2} do -- blinds
    add(box{min={x, 1.2, -0.05}, max={x + 1.3, 2.9, 0.14}}:material{color=0.05})
    for k = 0, 27 do
        add(box{min={x + 0.04, 1.23 + 0.06 * k, 0.14}, max={x + 1.26, 1.26 + 0.06 * k, 0.16}}:material{color=0.75})
    end
end
for k = -30, 30 do
    add(box{min={k / 5, 0, 3}, max={k / 5 + 0.11, 0.9, 3.03}}:material{color={0.9, 0.9, 0.88}})
end
