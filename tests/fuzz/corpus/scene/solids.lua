camera{eye={0, 1, 6}, look_at={0, 0, 0}, fov=50}:velocity{1, 0, 0}
light{point={3, 4, 5}, look_at={0, 0, 0}, inner=20, outer=40, fall_off=1}:spin{rpm=9}
light{direction={0, -1, -1}, color=0.5, shadows=false}
add(ellipsoid{radii={1, 2, 0.5}}:material{specular=1, shininess=3})
add(quadric{1, 0, 1, 0, 0, 0, 0, -1, 0, 0} * box{min={-1, -1, -1}, max={1, 2, 1}})
add(polyhedron{planes={{1, 0, 0, 1}, {-1, 0, 0, 1}, {0, 1, 0, 1}, {0, -1, 0, 1}, {1, 1, 1, 1.5}, {0, 0, 1, 1}, {0, 0, -1, 1}}}:rotate{axis={1, 1, 0}, degrees=40}:matrix{1, 0, 0, 2, 0, 1, 0, 0, 0, 0, 1, 0})
add(torus{axis={1, 0, 0}, major=1, minor=2}:temporal_width(0):material{texture=stripe{1, 0, size=0.3}})
add(cone{from={0, 0, 0}, to={0, 0, 3}, radii={0, 1}}:scale(0.5):spin{axis={1, 0, 0}, rpm=100, center={0, 1, 0}})
background(0.5) depth(2) duration(1) color_space 'lin_rec709'
