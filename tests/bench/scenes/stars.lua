-- Few and far between, so small that no neighbor tells of them: bright points on black, which the
-- camera pans across.
camera{eye={0, 0, 20}, look_at={0, 0, 0}, fov=40}:spin{axis={0, 1, 0}, rpm=.05}
background(0)
for i = 1, param.n or 150 do
    add(sphere{center={math.random()*22 - 11, math.random()*16 - 8, math.random()*4 - 2}, radius=.02 + .03*math.random()}
        :material{unlit=true, color=.5 + 2.5*math.random()})
end
duration(10)
