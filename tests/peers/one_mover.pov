// A still life, and a striped ball that rolls past it: most of the picture never changes.
//
//   povray +Ione_mover.pov +L. +W720 +H576 +K0.04

#include "shelf.inc"
#for (I, 0, 4)
    #if (mod(I, 2))
        sphere { <I * 1.1 - 2.2, 0.5, 1.2>, 0.5 Paint(0.2 + 0.15 * I, 0.6, 0.9 - 0.2 * I) }
    #else
        cylinder { <I * 1.1 - 2.2, 0, 1.2>, <I * 1.1 - 2.2, 1.2 + 0.1 * I, 1.2>, 0.35 Paint(0.8, 0.5 - 0.1 * I, 0.2 + 0.1 * I) }
    #end
#end
torus { 0.5, 0.14 rotate <60, 20, 0> translate <-0.4, 0.75, 0.2> Paint(0.85, 0.7, 0.3) }
sphere { 0, 0.28
    texture { pigment { gradient y color_map { [0.5 rgb 0.9] [0.5 rgb <.1, .1, .4>] } scale 0.14 } finish { ambient 0.1 } }
    rotate -240 * clock * z translate <1.2 * clock - 1.4, 0.28, -1> }
