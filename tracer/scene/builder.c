/* The graph that a script builds, and how it is unfolded into a scene's arrays. */
#include "tracer/scene/builder.h"

#include <stdlib.h>
#include <string.h>

#include "tracer/scene/advice.h"
#include "tracer/scene/lua_table.h"
#include "tracer/scene/motion.h"

wf_builder *wf_builder_of(lua_State *lua) {
    return wf_sandbox_of(lua)->user;
}

void *wf_list_grow(lua_State *lua, wf_list *list, size_t item_bytes, size_t more) {
    if (list->count + more > list->capacity) {
        size_t capacity = list->count + more + list->capacity / 2 + 16;
        wf_sandbox_take(lua, (capacity - list->capacity) * item_bytes);
        void *grown = realloc(list->items, capacity * item_bytes);
        if (!grown) wf_scene_error(lua, "scene", "no memory");
        list->items = grown;
        list->capacity = capacity;
    }
    if (list->count + more > INT32_MAX) wf_scene_error(lua, "scene", "it is too large");
    void *first = (char *)list->items + list->count * item_bytes;
    memset(first, 0, more * item_bytes);
    list->count += more;
    return first;
}

int wf_node_new(lua_State *lua, wf_node node, const int *children) {
    wf_builder *b = wf_builder_of(lua);
    node.first_child = (int)b->children.count;
    if (node.child_count) {
        int *to = wf_list_grow(lua, &b->children, sizeof *to, (size_t)node.child_count);
        memcpy(to, children, (size_t)node.child_count * sizeof *to);
    }
    for (int n = 0; n < node.child_count; n++) wf_node_use(b, children[n]);
    node.place = wf_place_here(lua);
    *(wf_node *)wf_list_grow(lua, &b->nodes, sizeof node, 1) = node;
    return (int)b->nodes.count - 1;
}

void wf_node_use(wf_builder *b, int index) {
    ((wf_node *)b->nodes.items)[index].used = true;
}

const wf_node *wf_node_at(const wf_builder *b, int index) {
    return (const wf_node *)b->nodes.items + index;
}

/* ---- Unfolding ---- */

/* What stands around a node on the way to it. */
typedef struct context {
    int op, ops;  /* innermost operator, and how many there are */
    int material; /* -1: the default */
    int width;    /* index of widths; -1: the job's */
    bool chain;   /* no CSG between it and whoever set the material or width */
} context;

typedef struct visit {
    int node, next_child;
    context around;
} visit;

/* Each ray is carried through all of a solid's moving operators. */
#define MOST_OPS 256

static wf_op *out_op(wf_builder *b, int index) {
    return (wf_op *)b->out_ops.items + index;
}

static void give_width(const wf_builder *b, int width, wf_op *op) {
    op->own_width = width >= 0;
    op->width_fields = width >= 0 ? ((const double *)b->widths.items)[width] : 0;
}

static bool same_vec(wf_vec a, wf_vec b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static bool same_op(const wf_op *a, const wf_op *b) {
    return a->kind == b->kind && a->outer == b->outer && a->own_width == b->own_width &&
           a->width_fields == b->width_fields && a->first_key == b->first_key &&
           same_vec(a->velocity, b->velocity) && same_vec(a->axis, b->axis) &&
           same_vec(a->center, b->center) && a->turns_a_second_num == b->turns_a_second_num &&
           !memcmp(&a->place, &b->place, sizeof a->place);
}

/* How many of the last operators are looked through for an equal one: a script mostly adds the
 * solids that move together one after another. */
#define RECENT 32

static int add_op(lua_State *lua, wf_builder *b, wf_op op) {
    int count = (int)b->out_ops.count, oldest = count > RECENT ? count - RECENT : 0;
    for (int n = count - 1; n >= oldest; n--)
        if (same_op(out_op(b, n), &op)) return n;
    *(wf_op *)wf_list_grow(lua, &b->out_ops, sizeof op, 1) = op;
    return (int)b->out_ops.count - 1;
}

/* Two placements in a row are one. */
static void enter_op(lua_State *lua, wf_builder *b, const wf_node *node, context *c) {
    wf_op op = ((const wf_op *)b->ops.items)[node->index];
    op.outer = c->op;
    give_width(b, c->width, &op);
    if (op.kind == WF_OP_PLACE && c->op >= 0 && out_op(b, c->op)->kind == WF_OP_PLACE) {
        wf_affine inner = op.place;
        op.place = wf_compose(&out_op(b, c->op)->place, &inner);
        op.outer = out_op(b, c->op)->outer;
        c->ops--;
    }
    if (++c->ops > MOST_OPS)
        wf_scene_error(lua, "add", "a solid goes through more than %d motions, one in another",
                       MOST_OPS);
    c->op = add_op(lua, b, op);
}

/* All that moves a solid looks through its own window: the operators around it, too, which
 * others may share and which are therefore made again. */
static int clone_ops(lua_State *lua, wf_builder *b, int op, int width) {
    if (op < 0) return -1;
    int outer = clone_ops(lua, b, out_op(b, op)->outer, width);
    wf_op copy = *out_op(b, op);
    copy.outer = outer;
    give_width(b, width, &copy);
    return add_op(lua, b, copy);
}

static void enter(lua_State *lua, wf_builder *b, const wf_node *node, context *c) {
    switch ((wf_node_kind)node->kind) {
    case WF_NODE_OP:
        enter_op(lua, b, node, c);
        return;
    case WF_NODE_MATERIAL:
        if (c->material < 0 || !c->chain) c->material = node->index;
        c->chain = true;
        return;
    case WF_NODE_WIDTH:
        if (c->width < 0 || !c->chain) {
            c->width = node->index;
            c->op = clone_ops(lua, b, c->op, c->width);
        }
        c->chain = true;
        return;
    default:
        c->chain = false;
    }
}

/* The placements nearest to a solid are put into the solid itself. */
static void settle(lua_State *lua, wf_builder *b, wf_solid *solid) {
    solid->written = -1;
    if (solid->op >= 0 && out_op(b, solid->op)->kind == WF_OP_PLACE) {
        wf_affine place = solid->place;
        solid->written = solid->op;
        solid->place = wf_compose(&out_op(b, solid->op)->place, &place);
        solid->op = out_op(b, solid->op)->outer;
    }
    if (!wf_invert(&solid->place, &solid->inverse))
        wf_scene_error(lua, "add", "a solid is scaled beyond all numbers");
}

static void emit_solid(lua_State *lua, wf_builder *b, const wf_node *node, const context *c) {
    wf_solid solid = ((const wf_solid *)b->solids.items)[node->index];
    solid.op = c->op;
    solid.material = c->material < 0 ? 0 : c->material;
    settle(lua, b, &solid);
    *(wf_solid *)wf_list_grow(lua, &b->out_solids, sizeof solid, 1) = solid;
    *(wf_step *)wf_list_grow(lua, &b->out_steps, sizeof(wf_step), 1) =
        (wf_step){WF_STEP_SOLID, (int)b->out_solids.count - 1};
}

/* What is still to be visited is kept as a Lua value, so that errors lose no memory. */
typedef struct route {
    visit *visits;
    int count, capacity;
} route;

static void go_to(lua_State *lua, route *r, int node, const context *around) {
    if (r->count == r->capacity) {
        int capacity = 2 * r->capacity + 64;
        visit *grown = lua_newuserdatauv(lua, (size_t)capacity * sizeof *grown, 0);
        if (r->count) memcpy(grown, r->visits, (size_t)r->count * sizeof *grown);
        lua_replace(lua, -2); /* the one before may be collected */
        r->visits = grown;
        r->capacity = capacity;
    }
    r->visits[r->count++] = (visit){node, 0, *around};
}

/* How deep the evaluation stack of the steps from first on gets. */
static int most_stack(const wf_step *steps, size_t first, size_t end) {
    int depth = 0, most = 0;
    for (size_t k = first; k < end; k++) {
        depth += steps[k].kind == WF_STEP_SOLID ? 1 : 1 - steps[k].count;
        if (depth > most) most = depth;
    }
    return most;
}

/* One visit: a node is entered when it is first seen, and left when its children are done. */
static void step(lua_State *lua, wf_builder *b, route *r) {
    visit *v = &r->visits[r->count - 1];
    wf_node node = *wf_node_at(b, v->node);
    if (!v->next_child) enter(lua, b, &node, &v->around);
    if (v->next_child < node.child_count) {
        int child = ((const int *)b->children.items)[node.first_child + v->next_child++];
        context around = v->around;
        wf_sandbox_charge(lua, 1);
        go_to(lua, r, child, &around);
        return;
    }
    if (node.kind == WF_NODE_SOLID) emit_solid(lua, b, &node, &v->around);
    if (node.kind == WF_NODE_CSG && node.child_count > 1)
        *(wf_step *)wf_list_grow(lua, &b->out_steps, sizeof(wf_step), 1) =
            (wf_step){(wf_step_kind)node.step, node.child_count};
    r->count--;
}

void wf_unfold(lua_State *lua, int node) {
    wf_builder *b = wf_builder_of(lua);
    const context world = {-1, 0, -1, -1, true};
    route r = {0};
    wf_node_use(b, node);
    size_t first = b->out_steps.count;
    lua_pushnil(lua);
    go_to(lua, &r, node, &world);
    while (r.count > 0) step(lua, b, &r);
    lua_pop(lua, 1);
    size_t end = b->out_steps.count;
    *(wf_object *)wf_list_grow(lua, &b->out_objects, sizeof(wf_object), 1) =
        (wf_object){(int)first, (int)(end - first), most_stack(b->out_steps.items, first, end)};
}

int wf_unfold_ops(lua_State *lua, int node) {
    wf_builder *b = wf_builder_of(lua);
    context c = {-1, 0, -1, -1, true};
    for (;;) {
        wf_node n = *wf_node_at(b, node);
        if (n.kind == WF_NODE_CAMERA || n.kind == WF_NODE_LIGHT) return c.op;
        enter(lua, b, &n, &c);
        node = ((const int *)b->children.items)[n.first_child];
    }
}
