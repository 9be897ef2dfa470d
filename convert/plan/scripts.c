/* A plan as what renderers take: a script for Blender and for Houdini, an INI file for POV-Ray.
 */
#include <inttypes.h>

#include "convert/plan/tell.h"

/* "[(0, '0/1', (0, 0, 720, 486)),": number, time and region, a row a subframe, in Python. */
static void put_rows(const wf_plan *plan, FILE *to) {
    char time[48];
    fputs(
        "SUBFRAMES = [  # number, seconds, pixels wanted: x0, y0, x1, y1 from the upper left\n",
        to);
    for (size_t i = 0; i < plan->count; i++) {
        const wf_plan_subframe *s = &plan->subframe[i];
        fprintf(to, "    (%" PRId64 ", '%s', (%d, %d, %d, %d)),\n", s->number,
                wf_plan_ratio_text(wf_plan_time(plan, s->number), time), s->region.x0,
                s->region.y0, s->region.x1, s->region.y1);
    }
    fputs("]\n", to);
}

static void put_constants(const wf_plan *plan, FILE *to) {
    char text[48];
    fprintf(to, "RASTER = '%s'\nRATE = '%s'  # subframes a second\n", plan->job.raster.name,
            wf_plan_ratio_text(plan->rate, text));
    fprintf(to, "SIZE = (%d, %d)\nPIXEL_ASPECT = (%" PRId64 ", %" PRId64 ")\n", plan->width_px,
            plan->lines, plan->pixel_aspect.num, plan->pixel_aspect.den);
    if (plan->samples)
        fprintf(to, "SAMPLES = %" PRId64 "  # a pixel\n", plan->samples);
    else
        fputs("SAMPLES = None  # a pixel: the scene's\n", to);
    if (wf_ratio_given(plan->job.scene_fps))
        fprintf(to, "FPS = '%s'  # frames a second of the scene\n",
                wf_plan_ratio_text(plan->job.scene_fps, text));
    else
        fputs("FPS = None  # frames a second of the scene: what it says\n", to);
}

/* ---- Blender ---- */

/* How a scene is made ready, and put back: the add-on's own lines. */
static const char blender_scene[] =
#include "convert/plan/blender_scene.inc"
    ;

static const char blender_render[] =
    "\n"
    "\n"
    "def render(folder):\n"
    "    scene = bpy.context.scene\n"
    "    settings = scene.render\n"
    "    fps = Fraction(FPS) if FPS else Fraction(settings.fps) / "
    "Fraction(settings.fps_base).limit_denominator(1001)\n"
    "    plan = {'size': SIZE, 'pixel_aspect': PIXEL_ASPECT}\n"
    "    os.makedirs(folder, exist_ok=True)\n"
    "    with prepared(scene, plan, settings.film_transparent, SAMPLES or 0):\n"
    "        for number, seconds, _ in SUBFRAMES:\n"
    "            path = os.path.join(folder, f'shot.{number:04d}.exr')\n"
    "            if os.path.exists(path):\n"
    "                continue\n"
    "            frame = scene.frame_start + Fraction(seconds) * fps\n"
    "            scene.frame_set(frame.numerator // frame.denominator, subframe=float(frame % "
    "1))\n"
    "            settings.filepath = path + '.part'\n"
    "            bpy.ops.render.render(write_still=True)\n"
    "            os.replace(path + '.part', path)\n"
    "\n"
    "\n"
    "if __name__ == '__main__':\n"
    "    render(sys.argv[sys.argv.index('--') + 1] if '--' in sys.argv else '.')\n";

void wf_plan_for_blender(const wf_plan *plan, FILE *to) {
    fputs("# Renders the subframes of a plan: blender -b shot.blend -P THIS.py -- FOLDER\n"
          "# Files that are there are kept; 'weft plan --help' tells what the plan is for.\n"
          "import os\nimport sys\nfrom fractions import Fraction\n\nimport bpy\n\n",
          to);
    put_constants(plan, to);
    put_rows(plan, to);
    fputs("\n", to);
    fputs(blender_scene, to);
    fputs(blender_render, to);
}

/* ---- Houdini ---- */

static const char houdini_render[] =
    "\n"
    "\n"
    "def render(hip, node, folder):\n"
    "    hou.hipFile.load(hip)\n"
    "    rop = hou.node(node)\n"
    "    fps = Fraction(FPS) if FPS else Fraction(hou.fps()).limit_denominator(1001)\n"
    "    picture = next(p for p in ('vm_picture', 'outputimage', 'picture') if rop.parm(p))\n"
    "    for number, seconds, (x0, y0, x1, y1) in SUBFRAMES:\n"
    "        path = os.path.join(folder, f'shot.{number:04d}.exr')\n"
    "        if os.path.exists(path) and (x0, y0, x1, y1) == (0, 0) + SIZE:\n"
    "            continue\n"
    "        rop.parm(picture).set(path)\n"
    "        frame = float(1 + Fraction(seconds) * fps)\n"
    "        rop.render(frame_range=(frame, frame, 1), res=SIZE)\n"
    "\n"
    "\n"
    "if __name__ == '__main__':\n"
    "    render(*sys.argv[1:4])\n";

void wf_plan_for_houdini(const wf_plan *plan, FILE *to) {
    fputs("# Renders the subframes of a plan: hython THIS.py SHOT.hip /out/ROP FOLDER\n"
          "# Written from Houdini's documentation, and not run. Turn motion blur off, and set "
          "the\n"
          "# camera's pixel aspect to PIXEL_ASPECT and the pixel filter to a box of width 1.\n"
          "import os\nimport sys\nfrom fractions import Fraction\n\nimport hou\n\n",
          to);
    put_constants(plan, to);
    put_rows(plan, to);
    fputs(houdini_render, to);
}

/* ---- POV-Ray ---- */

/* Rows and columns of POV-Ray are counted from 1, the last included. */
static void put_rectangle(const wf_box *box, FILE *to) {
    fprintf(to, "Start_Column=%d\nEnd_Column=%d\nStart_Row=%d\nEnd_Row=%d\n", box->x0 + 1,
            box->x1, box->y0 + 1, box->y1);
}

void wf_plan_for_povray(const wf_plan *plan, FILE *to) {
    char time[48];
    fprintf(to,
            "; Renders the subframes of a plan, one a section: povray SHOT.pov THIS.ini[480]\n"
            "; clock is the time in seconds. The camera's right vector is x*%d/%d*%" PRId64
            "/%" PRId64 ".\n",
            plan->width_px, plan->lines, plan->pixel_aspect.num, plan->pixel_aspect.den);
    fprintf(to, "Width=%d\nHeight=%d\nOutput_File_Type=E\nAntialias=Off\nDisplay=Off\n",
            plan->width_px, plan->lines);
    for (size_t i = 0; i < plan->count; i++) {
        const wf_plan_subframe *s = &plan->subframe[i];
        wf_rational seconds = wf_plan_time(plan, s->number);
        fprintf(
            to,
            "\n[%" PRId64 "]\n; %s s\nClock=%.12g\nOutput_File_Name=shot.%04" PRId64 ".exr\n",
            s->number, wf_plan_ratio_text(seconds, time), wf_ratio_value(seconds), s->number);
        if (plan->job.refine) put_rectangle(&s->region, to);
    }
}
