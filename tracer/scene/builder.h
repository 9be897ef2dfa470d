#ifndef WF_TRACER_SCENE_BUILDER_H
#define WF_TRACER_SCENE_BUILDER_H

#include "tracer/scene/load.h"
#include "tracer/scene/sandbox.h"

/* A scene while its script runs: a graph of nodes, in which a figure that stands in six places
 * is described once. Adding a solid to the picture unfolds it into the scene's flat arrays. */

typedef enum wf_node_kind {
    WF_NODE_SOLID,
    WF_NODE_CSG,
    WF_NODE_OP,
    WF_NODE_MATERIAL,
    WF_NODE_WIDTH,
    WF_NODE_CAMERA,
    WF_NODE_LIGHT
} wf_node_kind;

/* Where in the script something was said. */
typedef struct wf_place {
    int file, line; /* of the builder's files; line 0: nowhere */
} wf_place;

/* One node. Its kind says which array `index` counts in. */
typedef struct wf_node {
    uint8_t kind, step; /* step: wf_step_kind of a CSG node */
    bool used;          /* in another node, or in the picture */
    wf_place place;
    int index; /* of the builder's solids, ops, materials, widths or lights */
    int first_child, child_count;
} wf_node;

/* An array that grows within the script's memory. */
typedef struct wf_list {
    void *items;
    size_t count, capacity;
} wf_list;

/* How many warnings a scene gets, and how many names that nothing defined are looked at. */
#define WF_MOST_ADVICE 8
#define WF_MOST_MISSED 8

typedef struct wf_advice {
    wf_place place;
    const char *what;
} wf_advice;

/* A global that the script read and that was not there. */
typedef struct wf_missed {
    char name[48];
    wf_place place;
} wf_missed;

typedef struct wf_builder {
    wf_sandbox sandbox;
    const wf_load_options *options;
    char *folder; /* of the scene, absolute, ends with '/' */
    wf_scene *scene;
    wf_list nodes, children;     /* wf_node, int */
    wf_list solids, ops, widths; /* as described: wf_solid, wf_op, double */
    wf_list out_ops, out_solids, out_steps, out_objects; /* unfolded */
    wf_list keys, materials, images, planes, lights;
    wf_list light_nodes; /* int: the node each light stands for */
    int camera_node;     /* -1: none yet */
    int include_depth;
    wf_list files; /* names of files of places */
    wf_advice advice[WF_MOST_ADVICE];
    wf_missed missed[WF_MOST_MISSED];
    int advice_count, missed_count;
    size_t printed_bytes;
} wf_builder;

wf_builder *wf_builder_of(lua_State *lua);

/* Adds `more` items to the end of a list; returns the first of them, zeroed. Raises a Lua error
 * when memory is out. */
void *wf_list_grow(lua_State *lua, wf_list *list, size_t item_bytes, size_t more);

/* A new node with children (copied); returns its index. */
int wf_node_new(lua_State *lua, wf_node node, const int *children);
const wf_node *wf_node_at(const wf_builder *builder, int index);

/* Marks a node as part of something. */
void wf_node_use(wf_builder *builder, int index);

/* Unfolds a solid's node into the scene: one object. Raises Lua errors. */
void wf_unfold(lua_State *lua, int node);

/* Unfolds what is around a camera's or light's node into operators; returns the innermost. */
int wf_unfold_ops(lua_State *lua, int node);

#endif
