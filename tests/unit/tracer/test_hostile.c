/* Scripts that mean harm: whatever they try, they end with their budget's message soon after it
 * is spent, and nothing in them catches that. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <cmocka.h>

#include "tests/unit/support/scene_fields.h"
#include "tests/unit/support/sizes.h"

#define CAMERA  "camera{eye={0, 0, 5}, look_at={0, 0, 0}}\n"
#define FOREVER "function() while true do end end"

/* A table of as many entries as it likes to say, all made up. */
#define LIAR                                                                                   \
    "local t = setmetatable({}, {__len=function() return n end, __index=rawlen, "              \
    "__newindex=rawlen}) "

/* A text of 2^22 letters. */
#define LONG "local s = ('x'):rep(1 << 22) "

/* 2^16 keys that are not there any more. */
#define HOLES                                                                                  \
    "local h = {} for i = 1, 1 << 16 do h['k' .. i] = true end h.k = 1 "                       \
    "for k in pairs(h) do h[k] = nil end "

static const struct {
    const char *text, *says; /* says NULL: a budget's words, or that the stack is full */
} hostile[] = {
    /* Catching. */
    {"xpcall(" FOREVER ", " FOREVER ")", "steps"},
    {"while true do xpcall(" FOREVER ", function(m) return m end) end", "steps"},
    {"while true do pcall(" FOREVER ") end", "steps"},
    {"local function f() pcall(f) f() end f()", NULL},
    {"local function f() xpcall(f, f) f() end f()", NULL},
    {"xpcall(" FOREVER ", function() error(setmetatable({}, {__tostring=" FOREVER "})) end)",
     "steps"},
    {"xpcall(error, function() error() end) while true do end", "steps"},
    {"pcall(pcall, pcall, pcall, " FOREVER ")", "steps"},
    {"pcall(pairs, setmetatable({}, {__pairs=" FOREVER "}))", "steps"},
    {"while true do pcall(function() local s = 'x' while true do s = s .. s end end) end",
     NULL},
    {"while true do pcall(string.rep, 'x', 1e12) end", "memory"},
    {"local t = {} while true do pcall(function() t[#t + 1] = ('x'):rep(1000) .. #t end) end",
     NULL},
    {"local x <close> = setmetatable({}, {__close=" FOREVER "}) while true do end", "steps"},
    {"local function f() local x <close> = setmetatable({}, {__close=f}) f() end f()", NULL},
    {"pcall(function() local x <close> = setmetatable({}, {__close=" FOREVER "}) error() end)",
     "steps"},
    {"while true do pcall(sphere, {radius=-1}) end", "steps"},

    /* Lengths that are made up, and functions of C as metamethods. */
    {"local n = 2147483646 " LIAR "table.sort(t)", "steps"},
    {"local n = 1 << 40 " LIAR "table.concat(t)", "steps"},
    {"local n = 1 << 40 " LIAR "table.insert(t, 1, 1)", "steps"},
    {"local n = 1 << 40 " LIAR "table.remove(t, 1)", "steps"},
    {"local n = 1 << 40 " LIAR "table.unpack(t)", "steps"},
    {"local n = 1 << 40 " LIAR "table.move(t, 1, #t, 2)", "steps"},
    {"local n, said = 1, 0 " LIAR
     "getmetatable(t).__len = function() said = said + 1 return said % 2 == 0 and 1 << 30 or 1 "
     "end while true do table.insert(t, 1, 1) table.concat(t) table.remove(t, 1) table.sort(t) "
     "table.unpack(t) end",
     "steps"},
    {"table.concat(setmetatable({}, {__index=" FOREVER "}), '', 1, 5)", "steps"},
    {"table.sort({3, 2, 1}, " FOREVER ")", "steps"},
    {"local m = {} m.__lt = " FOREVER " table.sort({setmetatable({}, m), setmetatable({}, m)})",
     "steps"},
    {"local t = {} for i = 1, 200 do t[i] = ('x'):rep(1 << 20) .. i end while true do "
     "table.sort(t) end",
     "steps"},
    {"local t = {} for i = 1, 1e5 do t[i] = i % 7 end while true do table.sort(t, rawequal) "
     "end",
     "steps"},
    {"local t = setmetatable({}, {__lt=" FOREVER "}) return t < t", "steps"},
    {"local t = setmetatable({}, {__concat=" FOREVER "}) return t .. t", "steps"},
    {"local t = setmetatable({}, {__name=('x'):rep(1e6)}) while true do tostring(t) end",
     "steps"},
    {"local t = {} for i = 1, 100 do t = setmetatable({}, {__index=t}) end "
     "while true do local x = t.x end",
     "steps"},

    /* Instructions that take long. */
    {LONG "local r = ('x'):rep(1 << 22) while true do local b = s == r .. '' end", "steps"},
    {LONG "local r = s:sub(1, -2) .. 'y' while true do local b = s < r end", "steps"},
    {LONG "while true do local b = s .. 'y' end", "steps"},
    {LONG "while true do pcall(function() return s + 1 end) end", "steps"},
    {LONG "while true do tonumber(s, 36) end", "steps"},
    {LONG "local t = {} while true do t[s .. 'y'] = 1 t = {} end", "steps"},
    {HOLES "while true do next(h) end", "steps"},
    {HOLES "while true do for k in pairs(h) do end end", "steps"},
    {"local t = {} for i = 1, 1 << 14 do t['k' .. i] = i end while true do pairs(t) end",
     "steps"},
    {"local function f(...) return select('#', ...), f(...) end f(table.unpack({}, 1, 9e5))",
     NULL},
    {"local function f(...) local n = select(-1, ...) return f(...) end "
     "f(table.unpack({}, 1, 1e5))",
     "steps"},
    {"::again:: goto again", "steps"},
    {"local t = {} for i = 1, 1 << 16 do t[i] = {} end "
     "while true do for i = 1, 100 do t[i] = nil end for i = 1, 100 do t[-i] = {} end "
     "for i = 1, 100 do t[-i] = nil end end",
     NULL},

    /* Texts and patterns. */
    {"string.find(('a'):rep(5000), ('a-'):rep(20) .. 'b')", "steps"},
    {";('a'):rep(1e5):find('[' .. ('b'):rep(1e5) .. ']')", "steps"},
    {";('a'):rep(1e5):find(('a'):rep(5e4) .. 'b', 1, true)", "steps"},
    {";('a'):rep(3e4):gsub('(.-)%1%1b', '')", "steps"},
    {";('('):rep(1e5):match('%b()')", "steps"},
    {"for w in ('a'):rep(1e5):gmatch('.-b') do end", "steps"},
    {LONG "while true do ;('%.9s'):rep(200):format(table.unpack(setmetatable({}, "
          "{__index=function() return s end}), 1, 200)) end",
     "steps"},
    {LONG "while true do string.pack(('z'):rep(100), table.unpack(setmetatable({}, "
          "{__index=function() return s end}), 1, 100)) end",
     NULL},
    {"local s = '' while true do s = s .. 'x' end", "steps"},

    /* Scenes that do not end. */
    {"local t = {} for i = 1, 64 do t[i] = {math.sin(i), math.cos(i), math.sin(9 * i), 1} end "
     "while true do polyhedron{planes=t} end",
     NULL},
    {"local t = {} for i = 1, 5e4 do t[i] = {0, 0, 1, 1} end while true do "
     "polyhedron{planes=t} end",
     NULL},
    {"while true do pcall(image, {file='no.png'}) end", "steps"},
    {"while true do add(sphere{}) end", NULL},
    {"local s = sphere{} while true do s = s:translate{1, 0, 0} end", NULL},
    {"local s = sphere{} for i = 1, 60 do s = union(s, s) end add(s)", NULL},
    {"while true do light{point={0, 1, 0}} end", NULL},
    {"while true do print(('x'):rep(1e5)) end", "steps"},
    {"while true do print(setmetatable({}, {__tostring=function() return 'x' end})) end",
     "steps"},
};

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static bool says_any(const char *why) {
    return strstr(why, "steps") || strstr(why, "memory") || strstr(why, "overflow");
}

/* Every script, by a small budget of steps and by a larger one with little memory. */
static void hostile_scripts_end(void **state) {
    static const struct {
        int64_t steps;
        size_t memory_bytes;
    } budgets[] = {{1000, (size_t)1 << 30}, {1500000, (size_t)200 << 20}};
    (void)state;
    for (size_t n = 0; n < sizeof hostile / sizeof *hostile; n += (size_t)test_step(3))
        for (size_t k = 0; k < sizeof budgets / sizeof *budgets; k++) {
            char text[2048], why[1024] = "";
            wf_scene scene;
            const wf_load_options options = {.steps = budgets[k].steps,
                                             .memory_bytes = budgets[k].memory_bytes};
            snprintf(text, sizeof text, "%s%s", CAMERA, hostile[n].text);
            double began = seconds();
            bool good = wf_scene_load_text(text, strlen(text), "test.lua", &options, &scene,
                                           why, sizeof why);
            double took = seconds() - began;
            wf_scene_free(&scene);
            const char *says = k ? hostile[n].says : NULL;
            if (good || !(says ? strstr(why, says) != NULL : says_any(why)))
                fail_msg("'%s' of %lld steps was answered '%s'", hostile[n].text,
                         (long long)budgets[k].steps, why);
            if (took > 2) fail_msg("'%s' took %.1f s", hostile[n].text, took);
            if (getenv("WEFT_TELL"))
                fprintf(stderr, "%6.3f %s | %s\n", took, hostile[n].text, why);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(hostile_scripts_end)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
