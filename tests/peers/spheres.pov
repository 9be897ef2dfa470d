// tests/bench/many/spheres.lua for POV-Ray 3.7; the spheres are in balls.inc, a macro call each.
#include "crowd.inc"
Look(<0, 5, 13>, <0, 0.4, 0>, 42)
#macro Ball(X, Y, Z, R, Red, Green, Blue)
    sphere { <X, Y, Z>, R texture { Paint(Red, Green, Blue, 0) } }
#end
#include "balls.inc"
