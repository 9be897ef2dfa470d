/* Solids, cameras and lights as values of a script. */
#include "tracer/scene/lua_node.h"

#include "tracer/scene/lua_table.h"

void wf_push_node(lua_State *lua, int node) {
    *(int *)lua_newuserdatauv(lua, sizeof(int), 0) = node;
    luaL_setmetatable(lua, WF_LUA_NODE);
}

int wf_check_node(lua_State *lua, int arg, const char *what) {
    const int *node = luaL_testudata(lua, arg, WF_LUA_NODE);
    if (!node && arg == 1 && lua_gettop(lua) == 1 && lua_istable(lua, 1))
        wf_scene_error(lua, what, "write s:%s{..} with a colon, not a dot", what);
    if (!node)
        wf_scene_error(lua, what, "value %d must be a solid, not %s", arg,
                       luaL_typename(lua, arg));
    return node ? *node : -1;
}

int wf_check_solid(lua_State *lua, int arg, int number, const char *what) {
    const int *node = luaL_testudata(lua, arg, WF_LUA_NODE);
    if (!node)
        wf_scene_error(lua, what, "value %d must be a solid, not %s", number,
                       luaL_typename(lua, arg));
    wf_node_kind kind = (wf_node_kind)wf_node_at(wf_builder_of(lua), *node)->kind;
    if (kind == WF_NODE_CAMERA || kind == WF_NODE_LIGHT)
        wf_scene_error(lua, what, "value %d must be a solid", number);
    return *node;
}

int wf_wrap_node(lua_State *lua, wf_node_kind kind, int index, const char *what) {
    wf_builder *b = wf_builder_of(lua);
    int child = wf_check_node(lua, 1, what), root = child;
    int node = wf_node_new(
        lua, (wf_node){.kind = (uint8_t)kind, .index = index, .child_count = 1}, &child);
    while (wf_node_at(b, root)->kind == WF_NODE_OP)
        root = ((const int *)b->children.items)[wf_node_at(b, root)->first_child];
    const wf_node *at = wf_node_at(b, root);
    bool fixed = at->kind == WF_NODE_CAMERA || at->kind == WF_NODE_LIGHT;
    if (fixed && kind != WF_NODE_OP) wf_scene_error(lua, what, "it is for solids");
    if (at->kind == WF_NODE_CAMERA) b->camera_node = node;
    if (at->kind == WF_NODE_LIGHT) ((int *)b->light_nodes.items)[at->index] = node;
    wf_push_node(lua, node);
    return 1;
}
