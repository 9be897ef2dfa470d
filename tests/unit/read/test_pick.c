/* Which channels of which part are the picture: the order of choice as a table of files, and
 * what is said of each. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "convert/read/choice/pick.h"

#define PARTS_MOST    5
#define CHANNELS_MOST 40

/* "name:A B G R|depth:Z": parts with their channels; '#' after a channel is whole numbers, '!'
 * an id of a Cryptomatte, '~' before a name a deep part. */
typedef struct file {
    char text[512];
    wf_part part[PARTS_MOST];
    wf_channel channel[PARTS_MOST][CHANNELS_MOST];
    int parts;
} file;

static void add_channel(file *f, char *word) {
    wf_part *part = &f->part[f->parts];
    wf_channel c = {.name = word};
    size_t last = strlen(word) - 1;
    c.whole_numbers = word[last] == '#';
    c.ids = word[last] == '!';
    if (c.whole_numbers || c.ids) word[last] = '\0';
    assert_true(part->count < CHANNELS_MOST);
    f->channel[f->parts][part->count++] = c;
}

static void make(file *f, const char *text) {
    char *parts = NULL, *channels = NULL;
    memset(f, 0, sizeof *f);
    snprintf(f->text, sizeof f->text, "%s", text);
    for (char *p = strtok_r(f->text, "|", &parts); p; p = strtok_r(NULL, "|", &parts)) {
        char *colon = strchr(p, ':');
        assert_true(colon && f->parts < PARTS_MOST);
        *colon = '\0';
        f->part[f->parts] = (wf_part){
            .name = *p == '~' ? p + 1 : p, .channel = f->channel[f->parts], .flat = *p != '~'};
        for (char *c = strtok_r(colon + 1, " ", &channels); c;
             c = strtok_r(NULL, " ", &channels))
            add_channel(f, c);
        f->parts++;
    }
}

/* "1 diffuse R G B A file option": part, layer or -, channels, reasons of layer and part. */
static void describe(const file *f, const wf_pick *pick, char *text, size_t size) {
    size_t used =
        (size_t)snprintf(text, size, "%d %s", pick->part, *pick->layer ? pick->layer : "-");
    for (int c = 0; c < pick->count; c++)
        used += (size_t)snprintf(text + used, size - used, " %s",
                                 f->channel[pick->part][pick->channel[c]].name);
    snprintf(text + used, size - used, ", %s %s", wf_reason_name(pick->layer_reason),
             wf_reason_name(pick->part_reason));
}

typedef struct row {
    const char *file, *layer, *part;
    const char *right; /* as describe has it; "!" and words of the refusal */
} row;

static void expect(const row *r) {
    file f;
    wf_pick pick;
    char got[512] = "", why[900] = "";
    make(&f, r->file);
    const wf_wish wish = {.layer = r->layer, .part = r->part, .only_part = -1};
    bool found = wf_pick_picture(f.part, f.parts, &wish, &pick, why, sizeof why);
    if (found) describe(&f, &pick, got, sizeof got);
    bool refused = r->right[0] == '!';
    if (found == refused || (refused ? !strstr(why, r->right + 1) : strcmp(got, r->right) != 0))
        fail_msg("%s: '%s%s' should be '%s'", r->file, got, why, r->right);
}

#define EXPECT_ALL(rows)                                                                       \
    for (size_t i = 0; i < sizeof(rows) / sizeof *(rows); i++) expect(&(rows)[i])

static void without_a_prefix(void **state) {
    (void)state;
    static const row rows[] = {
        {":A B G R", NULL, NULL, "0 - R G B A, default default"},
        {":b g r", NULL, NULL, "0 - r g b, default default"},
        {":blue green red", NULL, NULL, "0 - red green blue, default default"},
        {":Blue Green Red alpha", NULL, NULL, "0 - Red Green Blue alpha, default default"},
        {":B G R b g r", NULL, NULL, "0 - R G B, default default"},
        {":A B G R beauty.B beauty.G beauty.R", NULL, NULL, "0 - R G B A, default default"},
        {":B G R id# Z mask.V", NULL, NULL, "0 - R G B, default default"},
        {"N:N.X N.Y N.Z|rgba:A B G R", NULL, NULL, "1 - R G B A, default file"},
        {"depth:Z|x:B G R", NULL, NULL, "1 - R G B, default file"},
        {"glow:B G R|beauty:B G R", NULL, NULL, "1 - R G B, file file"},
        {"glow:B G R|BEAUTY:B G R", NULL, NULL, "1 - R G B, file file"},
        {"a:B G R|View.Combined:B G R|c:B G R", NULL, NULL, "2 - R G B, file file"},
        {"a:B G R|View.Combined:B G R", NULL, NULL, "1 - R G B, file file"},
        {"beauty:B G R|rgba:B G R", NULL, NULL, "1 - R G B, file file"},
        {"left:B G R|right:B G R", NULL, NULL,
         "!2 parts hold a picture and no one of them is named as the beauty; choose one with "
         "--part; it has part 0 'left': R G B; part 1 'right': R G B"},
        {"~deep:A B G R Z|flat:B G R", NULL, NULL, "1 - R G B, default file"},
        {"~deep:A B G R Z", NULL, NULL, "!no flat picture, only deep ones; it has R G B A Z"},
        {"crypto_object:B G R|main:B G R", NULL, NULL, "1 - R G B, default file"},
    };
    EXPECT_ALL(rows);
}

/* What holds numbers for R G B is only taken if it is asked for. */
static void data(void **state) {
    (void)state;
    static const char *const names[] = {"N",        "world_normal",  "WorldPosition",
                                        "depthRaw", "ObjectID",      "Pworld",
                                        "V.Vector", "VRayNormals",   "st",
                                        "uv_pass",  "motionVectors", "mat.ID"};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        char alone[128], beside[200], right[128];
        snprintf(alone, sizeof alone, ":%s.B %s.G %s.R", names[n], names[n], names[n]);
        snprintf(beside, sizeof beside, "%s glow.B glow.G glow.R", alone);
        snprintf(right, sizeof right, "0 %s %s.R %s.G %s.B, option default", names[n], names[n],
                 names[n], names[n]);
        const row rows[] = {{alone, NULL, NULL, "!there is no picture in it"},
                            {beside, NULL, NULL, "0 glow glow.R glow.G glow.B, file default"},
                            {alone, names[n], NULL, right}};
        EXPECT_ALL(rows);
    }
    static const row pictures[] = {
        {":sss.B sss.G sss.R", NULL, NULL, "0 sss sss.R sss.G sss.B, file default"},
        {":Idle.B Idle.G Idle.R", NULL, NULL, "0 Idle Idle.R Idle.G Idle.B, file default"},
        {":paid.B paid.G paid.R", NULL, NULL, "0 paid paid.R paid.G paid.B, file default"},
        {"motion graphics:B G R", NULL, NULL, "0 - R G B, default default"},
    };
    EXPECT_ALL(pictures);
}

static void by_name(void **state) {
    (void)state;
    static const row rows[] = {
        {":N.X N.Y N.Z RGBA.A RGBA.B RGBA.G RGBA.R", NULL, NULL,
         "0 RGBA RGBA.R RGBA.G RGBA.B RGBA.A, file default"},
        {":a Ci.b Ci.g Ci.r", NULL, NULL, "0 Ci Ci.r Ci.g Ci.b a, file default"},
        {":C.B C.G C.R d.B d.G d.R", NULL, NULL, "0 C C.R C.G C.B, file default"},
        {":Default.B Default.G Default.R d.B d.G d.R", NULL, NULL,
         "0 Default Default.R Default.G Default.B, file default"},
        {":beauty.blue beauty.green beauty.red d.B d.G d.R", NULL, NULL,
         "0 beauty beauty.red beauty.green beauty.blue, file default"},
        {":V.Combined.A V.Combined.B V.Combined.G V.Combined.R V.Diff.B V.Diff.G V.Diff.R",
         NULL, NULL,
         "0 V.Combined V.Combined.R V.Combined.G V.Combined.B V.Combined.A, file default"},
        {":V.combined.B V.combined.G V.combined.R V.x.B V.x.G V.x.R", NULL, NULL,
         "0 V.combined V.combined.R V.combined.G V.combined.B, file default"},
        {":V.Combined.B V.Combined.G V.Combined.R W.Combined.B W.Combined.G W.Combined.R", NULL,
         NULL, "!2 layers hold a picture"},
        {"d:d.B d.G d.R|x:rgba.B rgba.G rgba.R", NULL, NULL,
         "1 rgba rgba.R rgba.G rgba.B, file file"},
        {":L.B L.G L.R", NULL, NULL, "0 L L.R L.G L.B, file default"},
        {":L.B L.G L.R N.X N.Y N.Z P.B P.G P.R", NULL, NULL, "0 L L.R L.G L.B, file default"},
        {":d.A d.B d.G d.R s.B s.G s.R", NULL, NULL,
         "!2 layers hold a picture and no one of them is named as the beauty; choose one with "
         "--layer; it has d (R G B A), s (R G B)"},
        {":L.B L.G L.R id.B# id.G# id.R#", NULL, NULL, "0 L L.R L.G L.B, file default"},
        {":CryptoObject00.B CryptoObject00.G CryptoObject00.R x.B x.G x.R", NULL, NULL,
         "0 x x.R x.G x.B, file default"},
        {":x.B x.G x.R ids00.B! ids00.G! ids00.R!", NULL, NULL,
         "0 x x.R x.G x.B, file default"},
    };
    EXPECT_ALL(rows);
}

static void gray_and_chroma(void **state) {
    (void)state;
    static const row rows[] = {
        {":Y", NULL, NULL, "0 - Y Y Y, default default"},
        {":A Y", NULL, NULL, "0 - Y Y Y A, default default"},
        {":L.Y N.X N.Y N.Z", NULL, NULL, "0 L L.Y L.Y L.Y, file default"},
        {":X Y Z", NULL, NULL, "!no picture in it"},
        {":Y Z", NULL, NULL, "!no picture in it"},
        {":X Y", NULL, NULL, "!no picture in it"},
        {":U V Y", NULL, NULL, "!no picture in it"},
        {":N.X N.Y N.Z", NULL, NULL, "!it has N (X Y Z)"},
        {":depth.Y", NULL, NULL, "!no picture in it"},
        {":Y#", NULL, NULL, "!no picture in it"},
        {":BY RY Y", NULL, NULL, "0 - Y RY BY, default default"},
        {":A BY RY Y", NULL, NULL, "0 - Y RY BY A, default default"},
        {":RY Y", NULL, NULL, "!no picture in it"},
        {":Z", NULL, NULL, "!it has Z"},
        {":U V", NULL, NULL, "!it has U V"},
        {"depth:Z|N:N.X N.Y N.Z", NULL, NULL,
         "!it has part 0 'depth': Z; part 1 'N': N (X Y Z)"},
        {":CryptoMaterial00.B CryptoMaterial00.G CryptoMaterial00.R", NULL, NULL,
         "!no picture in it"},
    };
    EXPECT_ALL(rows);
}

static void what_is_asked_for(void **state) {
    (void)state;
    static const row rows[] = {
        {":B G R d.B d.G d.R", "d", NULL, "0 d d.R d.G d.B, option default"},
        {":B G R d.B d.G d.R", "D", NULL, "0 d d.R d.G d.B, option default"},
        {":D.B D.G D.R d.B d.G d.R", "d", NULL, "0 d d.R d.G d.B, option default"},
        {":B G R d.Y", "d", NULL, "0 d d.Y d.Y d.Y, option default"},
        {":B G R N.B N.G N.R", "N", NULL, "0 N N.R N.G N.B, option default"},
        {":B G R N.X N.Y N.Z", "N", NULL, "!layer 'N' is no picture"},
        {":B G R Crypto00.B Crypto00.G Crypto00.R", "Crypto00", NULL,
         "!layer 'Crypto00' is no picture"},
        {":B G R", "specular", NULL, "!no layer 'specular'; it has R G B"},
        {"depth:Z|rgba:A B G R|diffuse:diffuse.B diffuse.G diffuse.R", "specular", NULL,
         "!no layer 'specular'; it has part 0 'depth': Z; part 1 'rgba': R G B A; part 2 "
         "'diffuse': diffuse (R G B)"},
        {"depth:Z|rgba:A B G R|diffuse:diffuse.B diffuse.G diffuse.R", "diffuse", NULL,
         "2 diffuse diffuse.R diffuse.G diffuse.B, option file"},
        {"a:B G R|glow:B G R", "glow", NULL, "1 - R G B, option file"},
        {"a:B G R|b:B G R", NULL, "b", "1 - R G B, default option"},
        {"a:B G R|b:B G R", NULL, "0", "0 - R G B, default option"},
        {"a:B G R|0:B G R", NULL, "0", "1 - R G B, default option"},
        {"a:B G R|b:B G R", NULL, "2", "!no part '2'; it has part 0 'a'"},
        {"a:B G R|b:B G R", NULL, "c", "!no part 'c'; it has part 0 'a'"},
        {"a:B G R|~b:B G R", NULL, "b", "!part 1 is not a flat picture"},
        {"a:B G R|N:B G R", NULL, "N", "1 - R G B, default option"},
        {"l:d.B d.G d.R|r:d.B d.G d.R", "d", NULL, "!2 parts have a layer 'd'"},
        {"l:d.B d.G d.R|r:d.B d.G d.R", "d", "r", "1 d d.R d.G d.B, option option"},
        {"a:B G R|b:x.B x.G x.R y.B y.G y.R", NULL, "b", "!2 layers hold a picture"},
    };
    EXPECT_ALL(rows);
}

/* A guess that may be wrong is told as one. */
static void another_beauty(void **state) {
    (void)state;
    static const struct {
        const char *file, *also;
    } rows[] = {{":beauty.B beauty.G beauty.R rgba.B rgba.G rgba.R", "beauty"},
                {":C.B C.G C.R x.Combined.B x.Combined.G x.Combined.R", "x.Combined"},
                {"beauty:B G R|rgba:B G R", "beauty"},
                {":rgba.B rgba.G rgba.R d.B d.G d.R", ""},
                {":B G R", ""}};
    const wf_wish wish = {.only_part = -1};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        file f;
        wf_pick pick;
        char why[900];
        make(&f, rows[i].file);
        assert_true(wf_pick_picture(f.part, f.parts, &wish, &pick, why, sizeof why));
        assert_string_equal(pick.also, rows[i].also);
    }
}

/* However many layers there are: the message ends with how many are not in it. */
static void long_lists_are_counted(void **state) {
    (void)state;
    static char names[CHANNELS_MOST][64];
    wf_channel channel[CHANNELS_MOST];
    for (int i = 0; i < CHANNELS_MOST; i++) {
        snprintf(names[i], sizeof names[i], "a_layer_with_a_long_name_%02d.Z", i);
        channel[i] = (wf_channel){.name = names[i]};
    }
    const wf_part part = {.name = "", .channel = channel, .count = CHANNELS_MOST, .flat = true};
    char list[200];
    wf_list_layers(&part, 1, list, sizeof list);
    assert_true(strlen(list) < sizeof list - 1);
    assert_non_null(strstr(list, "a_layer_with_a_long_name_00 (Z), "));
    assert_non_null(strstr(list, " more ('weft info' lists them)"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_a_prefix),
        cmocka_unit_test(by_name),
        cmocka_unit_test(data),
        cmocka_unit_test(gray_and_chroma),
        cmocka_unit_test(what_is_asked_for),
        cmocka_unit_test(another_beauty),
        cmocka_unit_test(long_lists_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
