-- Short sticks at every angle, crossing in the middle: a still picture whose spectrum is a star.

local lines = raster.lines

camera{eye={0, 0, 9}, look_at={0, 0, 0}, ortho_height=lines}
for n = 0, 11 do
    add(box{min={-lines / 3, -0.6, -1}, max={lines / 3, 0.6, 1}}:material{unlit=true, color=0.9}
        :rotate{axis={0, 0, 1}, degrees=15 * n + 4})
end
