"""Makes shot.blend, the shot of the tutorial: a wheel that rolls past lettering that stands still.

    blender -b --factory-startup -P shot.py -- shot.blend
"""
import math
import sys

import bpy

scene = bpy.context.scene
bpy.data.objects.remove(bpy.data.objects["Cube"])
scene.frame_start, scene.frame_end, scene.render.fps = 1, 4, 25
scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 16, False
scene.cycles.max_bounces = 2


def material(name, color, rough=0.6):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*color, 1)
    shader.inputs["Roughness"].default_value = rough
    return made


def add(kind, name, **how):
    getattr(bpy.ops.mesh, f"primitive_{kind}_add")(**how)
    bpy.context.object.data.materials.append(bpy.data.materials[name])
    return bpy.context.object


material("ground", (0.25, 0.27, 0.3))
material("rubber", (0.02, 0.02, 0.025))
material("wood", (0.55, 0.2, 0.04))
material("paint", (0.85, 0.83, 0.75), 0.3)
add("plane", "ground", size=60, location=(0, 0, -1))
add("plane", "ground", size=60, location=(0, 5, 0), rotation=(math.pi / 2, 0, 0))

bpy.ops.object.empty_add(location=(-4, 1, 0))
axle = bpy.context.object
parts = [add("torus", "rubber", location=axle.location, rotation=(math.pi / 2, 0, 0), major_radius=0.9, minor_radius=0.1)]
for k in range(6):
    spoke = add("cube", "wood", location=axle.location, rotation=(0, k * math.pi / 6, 0), scale=(0.9, 0.04, 0.05))
    parts.append(spoke)
for part in parts:
    part.parent = axle
    part.matrix_parent_inverse = axle.matrix_world.inverted()
for frame in (1, 26):  # a second: it rolls 6 units, 6 radians
    axle.location.x, axle.rotation_euler.y = -4 + 6 * (frame - 1) / 25, 6 * (frame - 1) / 25
    axle.keyframe_insert("location", frame=frame)
    axle.keyframe_insert("rotation_euler", frame=frame)
for curve in axle.animation_data.action.fcurves:
    for key in curve.keyframe_points:
        key.interpolation = "LINEAR"

bpy.ops.object.text_add(location=(-1.2, 2.5, -0.6), rotation=(math.pi / 2, 0, 0))
text = bpy.context.object
text.data.body, text.data.size, text.data.extrude = "1080i50", 1.3, 0.1
text.data.materials.append(bpy.data.materials["paint"])

camera, light = scene.camera, bpy.data.objects["Light"]
camera.location, camera.rotation_euler = (-0.5, -9, 1), (math.radians(83), 0, 0)
light.location, light.data.energy, light.data.shadow_soft_size = (3, -5, 6), 4000, 1
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[sys.argv.index("--") + 1])
