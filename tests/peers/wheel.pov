// A spoked wheel that fills half of the picture and rolls along at 150 turns a minute.
//
//   povray +Iwheel.pov +L. +W720 +H576 +K0.04

#include "shelf.inc"
#declare Radius = 1.5;
union {
    torus { Radius - 0.12, 0.12 rotate 90 * x Paint(0.06, 0.06, 0.07) }
    torus { Radius - 0.26, 0.05 rotate 90 * x Paint(0.75, 0.07, 0.05) }
    cylinder { -0.16 * z, 0.16 * z, 0.22 Paint(0.75, 0.07, 0.05) }
    #for (I, 0, 7)
        cylinder { 0.15 * y, (Radius - 0.24) * y, 0.045 rotate 45 * I * z Paint(0.7, 0.72 - 0.08 * I, 0.75) }
    #end
    rotate -900 * clock * z
    translate <1.2 * clock - 0.4, Radius, 0>
}
