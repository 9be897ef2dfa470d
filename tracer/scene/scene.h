#ifndef WF_TRACER_SCENE_SCENE_H
#define WF_TRACER_SCENE_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A scene after loading: plain data, immutable, any threads. Lengths are the scene's own units,
 * times seconds from the first field's instant, angles radians unless a name says otherwise.
 * Right-handed, y up. */

typedef struct wf_vec {
    double x, y, z;
} wf_vec;

/* p -> m p + d, m by rows. */
typedef struct wf_affine {
    double m[3][3];
    wf_vec d;
} wf_affine;

/* ---- Placement and motion ---- */

typedef enum wf_op_kind { WF_OP_PLACE, WF_OP_VELOCITY, WF_OP_SPIN, WF_OP_KEYS } wf_op_kind;

/* One key of a keyframed placement: between keys position and turn are interpolated linearly
 * (the turn along the shorter arc), before the first and after the last they stand. */
typedef struct wf_key {
    double time_s;
    wf_vec position;
    double turn[4]; /* unit quaternion, w x y z */
} wf_key;

/* An operator that carries points from inside it to outside. Operators form a forest: outer is
 * the one applied next, so that solids under one spin share it. */
typedef struct wf_op {
    wf_op_kind kind;
    int outer;           /* index of the operator applied after this one; -1: the world */
    wf_affine place;     /* WF_OP_PLACE; never singular */
    wf_vec velocity;     /* units a second, from t = 0 */
    wf_vec axis, center; /* WF_OP_SPIN: unit axis and a point on it */
    double turns_a_second_num, turns_a_second_den; /* exact doubles: 10 rpm is 10 / 60 */
    int first_key, key_count;
    bool own_width; /* it moves through a window of its own temporal width, in field periods */
    double width_fields;
} wf_op;

/* ---- Looks ---- */

typedef enum wf_texture_kind {
    WF_TEXTURE_NONE,
    WF_TEXTURE_CHECKER,
    WF_TEXTURE_STRIPE,
    WF_TEXTURE_ZONEPLATE,
    WF_TEXTURE_IMAGE,
    WF_TEXTURES
} wf_texture_kind;

/* Textures live in the space in which the solid was written, before any operator. */
typedef struct wf_texture {
    wf_texture_kind kind;
    float color[2][3];
    double size;                 /* checker: edge of a cell; stripe: width of one stripe */
    wf_vec axis;                 /* stripe: unit direction across the stripes */
    wf_vec center, across, down; /* zoneplate: its center; image: a corner; and unit axes */
    double height; /* zoneplate: H of 1/2 + 1/2 cos(pi r^2 / H), r in units; image: units */
    double width;  /* image: units along `across`, as height is along `down` */
    int image;     /* index of the scene's images */
    bool repeat;
} wf_texture;

typedef struct wf_image {
    int width_px, height_px;
    float *rgb; /* [height][width][3], scene-linear */
} wf_image;

typedef struct wf_material {
    float color[3];
    wf_texture texture; /* its color takes the place of color where there is one */
    float ambient, diffuse, specular, shininess, reflect;
    float refract; /* share of light that passes; 0: opaque */
    double index;  /* of refraction */
    bool unlit;    /* the color itself is what is seen */
    bool holdout;  /* what is behind the picture is seen in its place: alpha is 0 */
} wf_material;

/* ---- Solids ---- */

/* clang-format off */
/* Kinds in canonical form; where a solid stands and how big it is, its placement says.
 *   sphere      x^2 + y^2 + z^2 <= 1
 *   box         |x|, |y|, |z| <= 1
 *   cylinder    x^2 + z^2 <= 1, |y| <= 1
 *   cone        x^2 + z^2 <= (radius at y)^2, |y| <= 1; the radius is linear from shape[0] at
 *               y = -1 to shape[1] at y = 1, and the larger of them is 1
 *   torus       (sqrt(x^2 + z^2) - 1)^2 + y^2 <= shape[0]^2, 0 < shape[0]
 *   halfspace   y <= 0
 *   quadric     q0 x^2 + q1 y^2 + q2 z^2 + q3 xy + q4 yz + q5 zx + q6 x + q7 y + q8 z + q9 <= 0,
 *               q the ten numbers of shape
 *   polyhedron  n . p <= d for all of plane_count of the scene's planes from first_plane on;
 *               shape[6] > 0: its corners lie between shape[0..2] and shape[3..5] */
/* clang-format on */
typedef enum wf_solid_kind {
    WF_SPHERE,
    WF_BOX,
    WF_CYLINDER,
    WF_CONE,
    WF_TORUS,
    WF_HALFSPACE,
    WF_QUADRIC,
    WF_POLYHEDRON,
    WF_SOLID_KINDS
} wf_solid_kind;

typedef struct wf_plane {
    double n[3], d; /* n . p <= d; n of length 1 */
} wf_plane;

typedef struct wf_solid {
    wf_solid_kind kind;
    double shape[10];
    int first_plane, plane_count;
    wf_affine place; /* canonical to the space where op takes it up: never singular */
    wf_affine inverse;
    int op;      /* first operator applied to it; -1: it stands in the world */
    int written; /* the WF_OP_PLACE that `place` includes already: its inverse leads from op's
                    space to the one in which the solid was written; -1: that is the same */
    int material;
} wf_solid;

/* ---- CSG ---- */

typedef enum wf_step_kind {
    WF_STEP_SOLID,
    WF_STEP_UNION,
    WF_STEP_INTERSECTION,
    WF_STEP_DIFFERENCE
} wf_step_kind;

/* One step of an object's program, evaluated on a stack from its first step to its last: a
 * solid is pushed, an operation pops `count` results (the minuend of a difference lowest) and
 * pushes one. */
typedef struct wf_step {
    wf_step_kind kind;
    int count; /* operands; of a solid: its index */
} wf_step;

/* One add(): its steps and how deep the stack gets. */
typedef struct wf_object {
    int first_step, step_count, most_stack;
} wf_object;

/* ---- The whole ---- */

typedef enum wf_light_kind { WF_LIGHT_POINT, WF_LIGHT_DIRECTION, WF_LIGHT_SPOT } wf_light_kind;

typedef struct wf_light {
    wf_light_kind kind;
    wf_vec point;                /* where it stands */
    wf_vec direction;            /* unit, the way it shines */
    double cos_inner, cos_outer; /* spot: full inside, dark outside, smooth between */
    double fall_off;             /* 0: none; 2: by the squared distance, 1 at distance 1 */
    float color[3];
    int op; /* as of a solid */
    bool shadows;
} wf_light;

typedef struct wf_camera {
    wf_vec eye, forward, right, up; /* orthonormal */
    double half_height; /* perspective: tangent of half the vertical angle; else units */
    bool orthographic;
    int op; /* as of a solid */
} wf_camera;

typedef struct wf_scene {
    double duration_s;
    float background[3];
    float background_clear; /* 1 - alpha of it, which is 1 unless said */
    wf_camera camera;
    char color_space[64]; /* of its colors; "" : lin_rec709 */
    int depth_limit;      /* of reflections and refractions */
    wf_op *ops;
    wf_key *keys;
    wf_material *materials;
    wf_image *images;
    wf_solid *solids;
    wf_plane *planes;
    wf_step *steps;
    wf_object *objects;
    wf_light *lights;
    int op_count, key_count, material_count, image_count, solid_count, plane_count, step_count,
        object_count, light_count;
} wf_scene;

/* Whether anything may be seen through: its background, or a holdout. */
bool wf_scene_has_alpha(const wf_scene *scene);

/* Frees what the scene owns; the struct itself is the caller's. */
void wf_scene_free(wf_scene *scene);

#endif
