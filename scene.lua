camera{eye={0, 0, 100}, look_at={0, 0, 0}, ortho_height=raster.lines}
background{0.5, 0.25, 2, alpha=tonumber(param.alpha or 0)}
duration(0.04)
add(sphere{center={-8.3, 2.2, 0}, radius=5.1}:material{color=0.5, unlit=true}:velocity{param.speed or 30, 0, 0})
add(box{min={2.7, -10.4, -1}, max={6.2, 10.3, 1}}:material{color={0.25, 1, 0.5}, unlit=true}:velocity{0, param.speed or 40, 0})
add(box{min={-13, -11, 20}, max={-3, -6, 21}}:material{color=1, refract=0.5, index=1, unlit=true, ambient=0})
add(box{min={9, -8, -1}, max={15, 8, 1}}:material{color=0.75, unlit=true})
add(box{min={11, -4, 2}, max={15, 2, 3}}:material{holdout=true, unlit=true})
