-- Stripes whose pitch is about a pixel's, and a speck of light far above white that crosses them.
camera{eye={0, 0, 10}, look_at={0, 0, 0}, ortho_height=raster.lines}
background(0)
add(box{min={-2000, -2000, -1}, max={2000, 2000, 0}}
    :material{unlit=true, texture=stripe{1, 0, axis={.97, .24, 0}, size=.51}})
add(sphere{center={-8, 3, 3}, radius=.2}:material{unlit=true, color={200, 180, 150}}:velocity{60, 12, 0})
duration(10)
