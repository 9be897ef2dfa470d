/* Set operations on solids as functions and operators of a script. */
#include "tracer/scene/advice.h"
#include "tracer/scene/language.h"
#include "tracer/scene/lua_node.h"
#include "tracer/scene/lua_table.h"

/* Of solids one by one, or of one list of them: lists may be longer than argument lists. */
static int combine(lua_State *lua, wf_step_kind step, const char *what) {
    wf_builder *b = wf_builder_of(lua);
    bool list = lua_gettop(lua) == 1 && lua_istable(lua, 1);
    int count = list ? (int)lua_rawlen(lua, 1) : lua_gettop(lua);
    if (!count) wf_scene_error(lua, what, "it takes solids, and there are none");
    wf_sandbox_charge(lua, count);
    wf_node node = {.kind = WF_NODE_CSG,
                    .place = wf_place_here(lua),
                    .step = (uint8_t)step,
                    .first_child = (int)b->children.count,
                    .child_count = count};
    for (int k = 1; k <= count; k++) {
        if (list) lua_rawgeti(lua, 1, k);
        int child = wf_check_solid(lua, list ? 2 : k, k, what);
        if (list) lua_pop(lua, 1);
        wf_node_use(b, child);
        *(int *)wf_list_grow(lua, &b->children, sizeof(int), 1) = child;
    }
    *(wf_node *)wf_list_grow(lua, &b->nodes, sizeof node, 1) = node;
    wf_push_node(lua, (int)b->nodes.count - 1);
    return 1;
}

static int call_union(lua_State *lua) {
    return combine(lua, WF_STEP_UNION, "union");
}

static int call_intersection(lua_State *lua) {
    return combine(lua, WF_STEP_INTERSECTION, "intersection");
}

static int call_difference(lua_State *lua) {
    return combine(lua, WF_STEP_DIFFERENCE, "difference");
}

const luaL_Reg wf_lua_sets[] = {{"union", call_union},
                                {"intersection", call_intersection},
                                {"difference", call_difference},
                                {NULL, NULL}};

/* a + b, a * b, a - b. */
const luaL_Reg wf_lua_set_operators[] = {{"__add", call_union},
                                         {"__mul", call_intersection},
                                         {"__sub", call_difference},
                                         {NULL, NULL}};
