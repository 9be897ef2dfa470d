-- Rows of balls that mirror each other, before a mirror.
depth(5)
camera{eye={0, 5, 14}, look_at={0, 0.5, 0}, fov=40}
light{point={8, 14, 9}, color=0.8}
background{0.2, 0.3, 0.5}
add(halfspace{normal={0, 1, 0}, offset=-1}:material{texture=checker{0.8, 0.2}})
add(box{min={-7, -1, -6.2}, max={7, 4, -6}}:material{color=0.1, reflect=0.8})
for x = -4, 4 do
    for z = -4, 4 do
        add(sphere{center={1.3 * x, -0.4 + 0.2 * ((x + z) % 3), 1.3 * z}, radius=0.55}
            :material{color={0.5 + x / 10, 0.5 + z / 10, 0.5}, reflect=0.5})
    end
end
