/* The figures of a file as a JSON object. */
#include <string.h>

#include "convert/ask/measure.h"

/* Whether `name`, such as "flicker.visible", is the group that is open or lies in it. */
static bool lies_in(const char *open, const char *name) {
    size_t length = strlen(open);
    if (!length) return true;
    if (strlen(name) < length || memcmp(open, name, length) != 0) return false;
    return strlen(name) == length || name[length] == '.';
}

/* Closes objects until what is open is where `name` lies in. */
static void leave_groups(wf_json *json, char *open, const char *name) {
    while (!lies_in(open, name)) {
        char *dot = strrchr(open, '.');
        *(dot ? dot : open) = '\0';
        wf_json_close(json);
    }
}

/* Opens objects, one in the other, until `name` is open. */
static void enter_groups(wf_json *json, char open[64], const char *name) {
    size_t from = strlen(open), whole = strlen(name);
    while (from < whole) {
        char word[64];
        from += name[from] == '.';
        size_t length = strcspn(name + from, ".");
        snprintf(word, sizeof word, "%.*s", (int)length, name + from);
        wf_json_open(json, word, '{');
        from += length;
    }
    snprintf(open, 64, "%s", name);
}

/* Adds the figures, those of a group as an object: in the table they follow each other. */
static void add_figures(wf_json *json, const wf_figures *f) {
    const wf_figure_kind *kind;
    char open[64] = "";
    for (size_t i = 0; (kind = wf_figure_at(i)); i++) {
        leave_groups(json, open, kind->key ? kind->group : "");
        if (!kind->key) {
            wf_json_real(json, kind->group, wf_figure_value(f, kind));
            continue;
        }
        bool begins = strcmp(open, kind->group);
        enter_groups(json, open, kind->group);
        if (!strcmp(open, "order") && begins) wf_json_text(json, "verdict", f->order_verdict);
        wf_json_real(json, kind->key, wf_figure_value(f, kind));
    }
    leave_groups(json, open, "");
}

static void add_plane(wf_json *json, const char *key, const wf_plane_difference *d) {
    wf_json_open(json, key, '{');
    wf_json_real(json, "rmse", d->rmse);
    wf_json_real(json, "psnr", d->psnr);
    wf_json_real(json, "ssim", d->ssim);
    wf_json_close(json);
}

static void add_planes(wf_json *json, const wf_figures *f) {
    if (!f->plane_name[0]) return;
    wf_json_open(json, "planes", '{');
    for (int p = 0; p < 3 && f->plane_name[p]; p++) {
        wf_json_open(json, f->plane_name[p], '{');
        add_plane(json, "frame", &f->plane[p][0]);
        add_plane(json, "top", &f->plane[p][1]);
        add_plane(json, "bottom", &f->plane[p][2]);
        wf_json_close(json);
    }
    wf_json_close(json);
}

void wf_measure_json(wf_json *json, const char *path, const wf_figures *f, const char *error) {
    wf_json_open(json, NULL, '{');
    wf_json_text(json, "path", path);
    if (error) {
        wf_json_text(json, "error", error);
        wf_json_close(json);
        return;
    }
    wf_json_text(json, "format", f->info.format);
    wf_json_text(json, "raster", f->info.raster.name);
    wf_json_int(json, "frames", f->frames);
    add_figures(json, f);
    add_planes(json, f);
    wf_json_close(json);
}
