/* Reads a plot from JSON. Each object has a table of its keys; what is wrong
 * is told with the path of the key, such as items[2].points[0]. */
#include "convert/ask/plot_file.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/fail.h"
#include "filters/base/spelling.h"

typedef struct reading {
    wf_plot_file *file;
    const char *path;
    char where[160]; /* the key that is being read: "items[2].points" */
    weft_error *err;
} reading;

/* What a key is read by, and where to; a number is from low to high. */
typedef struct key_row {
    const char *name;
    weft_status (*read)(reading *r, const struct key_row *row, json_t *value, void *object);
    size_t offset;
    double low, high;
} key_row;

static weft_status refuse(const reading *r, const char *what) {
    return wf_fail(r->err, WEFT_USAGE, "%.300s: %s%s%s", r->path, r->where,
                   *r->where ? ": " : "", what);
}

static weft_status no_memory(const reading *r) {
    return wf_fail(r->err, WEFT_NO_MEMORY, "out of memory");
}

/* Adds a key or an index to where; returns the length that takes it away again. */
static size_t enter(reading *r, const char *key, size_t index) {
    size_t length = strlen(r->where);
    char *end = r->where + length;
    if (key)
        snprintf(end, sizeof r->where - length, "%s%.40s", length ? "." : "", key);
    else
        snprintf(end, sizeof r->where - length, "[%zu]", index);
    return length;
}

static void leave(reading *r, size_t length) {
    r->where[length] = '\0';
}

/* An array of numbers that lives as long as the file; NULL: memory is out. */
static double *keep_array(reading *r, size_t count) {
    wf_plot_file *f = r->file;
    double **grown = realloc(f->array, (f->arrays + 1) * sizeof *grown);
    if (!grown) return NULL;
    f->array = grown;
    double *array = malloc((count ? count : 1) * sizeof *array);
    if (array) f->array[f->arrays++] = array;
    return array;
}

/* ---- Values ---- */

static weft_status take_number(reading *r, json_t *value, double low, double high, double *to) {
    char what[96];
    *to = json_number_value(value);
    if (json_is_number(value) && *to >= low && *to <= high) return WEFT_OK;
    if (isinf(low))
        snprintf(what, sizeof what, "a number is wanted");
    else
        snprintf(what, sizeof what, "a number from %g to %g is wanted", low, high);
    return refuse(r, what);
}

static weft_status read_number(reading *r, const key_row *row, json_t *value, void *object) {
    double *to = (double *)(void *)((char *)object + row->offset);
    return take_number(r, value, row->low, row->high, to);
}

static weft_status read_whole(reading *r, const key_row *row, json_t *value, void *object) {
    int *to = (int *)(void *)((char *)object + row->offset);
    double number = 0;
    if (json_is_number(value) && !json_is_integer(value))
        return refuse(r, "a whole number is wanted");
    weft_status status = take_number(r, value, row->low, row->high, &number);
    *to = (int)number;
    return status;
}

static weft_status read_text(reading *r, const key_row *row, json_t *value, void *object) {
    const char **to = (const char **)(void *)((char *)object + row->offset);
    *to = json_string_value(value);
    return *to ? WEFT_OK : refuse(r, "text is wanted");
}

static weft_status read_flag(reading *r, const key_row *row, json_t *value, void *object) {
    *((bool *)object + row->offset) = json_is_true(value);
    return json_is_boolean(value) ? WEFT_OK : refuse(r, "true or false is wanted");
}

/* An array of exactly `count` numbers, every `step`-th of `to`. */
static weft_status take_numbers(reading *r, json_t *value, size_t count, const char *what,
                                double **to, size_t at) {
    weft_status status = WEFT_OK;
    if (json_array_size(value) != count) return refuse(r, what);
    for (size_t i = 0; i < count && !status; i++) {
        size_t length = enter(r, NULL, i);
        status = take_number(r, json_array_get(value, i), -INFINITY, INFINITY, &to[i][at]);
        leave(r, length);
    }
    return status;
}

/* An array of numbers, however many. */
static weft_status take_list(reading *r, json_t *value, const double **list, size_t *count) {
    weft_status status = WEFT_OK;
    if (!json_is_array(value)) return refuse(r, "an array of numbers is wanted");
    *count = json_array_size(value);
    double *to = keep_array(r, *count);
    if (!to) return no_memory(r);
    *list = to;
    for (size_t i = 0; i < *count && !status; i++) {
        size_t length = enter(r, NULL, i);
        status = take_number(r, json_array_get(value, i), -INFINITY, INFINITY, &to[i]);
        leave(r, length);
    }
    return status;
}

/* ---- Objects ---- */

static weft_status unknown_key(reading *r, const char *key, const key_row *rows, size_t count) {
    char what[400];
    wf_spelling spelling = {.text = key};
    size_t used = (size_t)snprintf(what, sizeof what, "there is no key '%.40s'; ", key);
    for (size_t i = 0; i < count; i++) wf_spelling_offer(&spelling, rows[i].name);
    if (spelling.best) {
        snprintf(what + used, sizeof what - used, "did you mean '%s'?", spelling.best);
        return refuse(r, what);
    }
    for (size_t i = 0; i < count; i++)
        used += (size_t)snprintf(what + used, sizeof what - used, "%s%s",
                                 i ? ", " : "it takes ", rows[i].name);
    return refuse(r, what);
}

static weft_status read_object(reading *r, json_t *value, const key_row *rows, size_t count,
                               void *object) {
    const char *key;
    json_t *member;
    if (!json_is_object(value)) return refuse(r, "an object is wanted");
    json_object_foreach(value, key, member) {
        size_t i = 0;
        while (i < count && strcmp(rows[i].name, key)) i++;
        if (i == count) return unknown_key(r, key, rows, count);
        size_t length = enter(r, key, 0);
        weft_status status = rows[i].read(r, &rows[i], member, object);
        if (status) return status;
        leave(r, length);
    }
    return WEFT_OK;
}

#define COUNT(array) (sizeof(array) / sizeof *(array))

/* ---- Axes ---- */

static weft_status read_ticks(reading *r, const key_row *row, json_t *value, void *object) {
    wf_plot_axis *axis = object;
    (void)row;
    if (json_array_size(value) > WF_PLOT_MOST_TICKS) return refuse(r, "at most 64 are drawn");
    return take_list(r, value, &axis->tick, &axis->ticks);
}

static const key_row axis_keys[] = {
    {"label", read_text, offsetof(wf_plot_axis, label), 0, 0},
    {"low", read_number, offsetof(wf_plot_axis, low), -INFINITY, INFINITY},
    {"high", read_number, offsetof(wf_plot_axis, high), -INFINITY, INFINITY},
    {"log", read_flag, offsetof(wf_plot_axis, log), 0, 0},
    {"ticks", read_ticks, 0, 0, 0},
    {"digits", read_whole, offsetof(wf_plot_axis, digits), 0, 9},
};

static weft_status check_axis(reading *r, const wf_plot_axis *axis) {
    if (axis->low == axis->high) return refuse(r, "low and high are one and the same");
    if (axis->log && (axis->low <= 0 || axis->high <= 0))
        return refuse(r, "low and high are above 0 on a logarithmic axis");
    for (size_t i = 0; axis->log && i < axis->ticks; i++)
        if (axis->tick[i] <= 0) return refuse(r, "ticks are above 0 on a logarithmic axis");
    return WEFT_OK;
}

static weft_status read_axis(reading *r, const key_row *row, json_t *value, void *object) {
    wf_plot_axis *axis = (wf_plot_axis *)(void *)((char *)object + row->offset);
    weft_status status = read_object(r, value, axis_keys, COUNT(axis_keys), axis);
    return status ? status : check_axis(r, axis);
}

/* The y axis is the panel's. */
static weft_status read_y_axis(reading *r, const key_row *row, json_t *value, void *object) {
    (void)object;
    return read_axis(r, row, value, &r->file->panel.y);
}

/* ---- Items ---- */

/* Makes space for points of an item. */
static weft_status begin_points(reading *r, wf_plot_item *item, size_t count, double *to[2]) {
    to[0] = keep_array(r, count);
    to[1] = to[0] ? keep_array(r, count) : NULL;
    item->x = to[0];
    item->y = to[1];
    item->points = count;
    return to[1] ? WEFT_OK : no_memory(r);
}

static weft_status read_points(reading *r, const key_row *row, json_t *value, void *object) {
    double *to[2];
    (void)row;
    if (!json_is_array(value) || !json_array_size(value))
        return refuse(r, "an array of points [x, y] is wanted");
    weft_status status = begin_points(r, object, json_array_size(value), to);
    for (size_t i = 0; i < json_array_size(value) && !status; i++) {
        size_t length = enter(r, NULL, i);
        status = take_numbers(r, json_array_get(value, i), 2, "a point is [x, y]", to, i);
        if (!status) leave(r, length);
    }
    return status;
}

static weft_status read_at(reading *r, const key_row *row, json_t *value, void *object) {
    double *to[2];
    (void)row;
    weft_status status = begin_points(r, object, 1, to);
    return status ? status : take_numbers(r, value, 2, "a point [x, y] is wanted", to, 0);
}

/* [x0, x1, y0, y1] as two points. */
static weft_status take_box(reading *r, json_t *value, double *to[2], size_t at) {
    double *ends[] = {to[0] + at, to[0] + at + 1, to[1] + at, to[1] + at + 1};
    return take_numbers(r, value, 4, "a box is [x0, x1, y0, y1]", ends, 0);
}

static weft_status read_box(reading *r, const key_row *row, json_t *value, void *object) {
    double *to[2];
    (void)row;
    weft_status status = begin_points(r, object, 2, to);
    return status ? status : take_box(r, value, to, 0);
}

static weft_status read_boxes(reading *r, const key_row *row, json_t *value, void *object) {
    double *to[2];
    (void)row;
    if (!json_is_array(value)) return refuse(r, "an array of boxes [x0, x1, y0, y1] is wanted");
    weft_status status = begin_points(r, object, 2 * json_array_size(value), to);
    for (size_t i = 0; i < json_array_size(value) && !status; i++) {
        size_t length = enter(r, NULL, i);
        status = take_box(r, json_array_get(value, i), to, 2 * i);
        if (!status) leave(r, length);
    }
    return status;
}

/* Of a rule, whose other place is everywhere. */
static weft_status read_place(reading *r, const key_row *row, json_t *value, void *object) {
    const double **place = (const double **)(void *)((char *)object + row->offset);
    double *to = keep_array(r, 1);
    if (!to) return no_memory(r);
    *place = to;
    ((wf_plot_item *)object)->points = 1;
    return take_number(r, value, -INFINITY, INFINITY, to);
}

/* From x0 to x1. */
static weft_status read_across(reading *r, const key_row *row, json_t *value, void *object) {
    wf_plot_item *item = object;
    double *x = keep_array(r, 2);
    (void)row;
    if (!x) return no_memory(r);
    item->x = x;
    item->points = 2;
    return take_numbers(r, value, 2, "[x0, x1] is wanted", (double *[]){x, x + 1}, 0);
}

static weft_status read_shift(reading *r, const key_row *row, json_t *value, void *object) {
    wf_plot_item *item = object;
    (void)row;
    return take_numbers(r, value, 2, "a shift is [right, down]",
                        (double *[]){&item->dx, &item->dy}, 0);
}

static weft_status read_range(reading *r, const key_row *row, json_t *value, void *object) {
    wf_plot_item *item = object;
    (void)row;
    weft_status status = take_numbers(r, value, 2, "a range is [least, most]",
                                      (double *[]){&item->least, &item->most}, 0);
    if (!status && item->least >= item->most)
        return refuse(r, "the first number is below the second");
    return status;
}

static weft_status read_anchor(reading *r, const key_row *row, json_t *value, void *object) {
    static const char *const words[] = {"start", "middle", "end"};
    (void)row;
    for (int i = 0; i < 3 && json_is_string(value); i++)
        if (!strcmp(json_string_value(value), words[i])) {
            ((wf_plot_item *)object)->anchor = i / 2.0;
            return WEFT_OK;
        }
    return refuse(r, "it is one of start, middle, end");
}

static weft_status read_shades(reading *r, const key_row *row, json_t *value, void *object) {
    size_t count;
    (void)row;
    return take_list(r, value, &((wf_plot_item *)object)->shade, &count);
}

static weft_status copy_values(reading *r, json_t *value, double *to, size_t columns) {
    weft_status status = WEFT_OK;
    for (size_t y = 0; y < json_array_size(value) && !status; y++) {
        json_t *line = json_array_get(value, y);
        size_t length = enter(r, NULL, y);
        if (json_array_size(line) != columns)
            return refuse(r, "it is not as long as the first row");
        for (size_t x = 0; x < columns && !status; x++)
            status = take_number(r, json_array_get(line, x), -INFINITY, INFINITY,
                                 &to[y * columns + x]);
        if (!status) leave(r, length);
    }
    return status;
}

static weft_status read_values(reading *r, const key_row *row, json_t *value, void *object) {
    enum { MOST = 16384 };
    wf_plot_item *item = object;
    (void)row;
    item->rows = json_array_size(value);
    item->columns = json_array_size(json_array_get(value, 0));
    if (!item->rows || !item->columns || item->rows > MOST || item->columns > MOST)
        return refuse(r, "an array of rows of numbers is wanted, at most 16384 of each");
    double *to = keep_array(r, item->rows * item->columns);
    if (!to) return no_memory(r);
    item->value = to;
    return copy_values(r, value, to, item->columns);
}

static weft_status read_nothing(reading *r, const key_row *row, json_t *value, void *object) {
    (void)r, (void)row, (void)value, (void)object;
    return WEFT_OK;
}

#define ITEM(member) offsetof(wf_plot_item, member)

static const key_row item_keys[] = {
    {"kind", read_nothing, 0, 0, 0}, /* was read before the others */
    {"name", read_text, ITEM(name), 0, 0},
    {"series", read_whole, ITEM(series), 0, WF_PLOT_SERIES},
    {"points", read_points, 0, 0, 0},
    {"at", read_at, 0, 0, 0},
    {"x", read_place, ITEM(x), 0, 0},
    {"y", read_place, ITEM(y), 0, 0},
    {"across", read_across, 0, 0, 0},
    {"box", read_box, 0, 0, 0},
    {"boxes", read_boxes, 0, 0, 0},
    {"values", read_values, 0, 0, 0},
    {"range", read_range, 0, 0, 0},
    {"text", read_text, ITEM(text), 0, 0},
    {"anchor", read_anchor, 0, 0, 0},
    {"shift", read_shift, 0, 0, 0},
    {"radius", read_number, ITEM(radius), 0.1, 1000},
    {"shades", read_shades, 0, 0, 0},
    {"dashed", read_flag, ITEM(dashed), 0, 0},
    {"hollow", read_flag, ITEM(hollow), 0, 0},
    {"below", read_flag, ITEM(below), 0, 0},
};

/* What an item of each kind needs and what else it may have. */
static const struct {
    const char *name, *needs, *may;
} kinds[] = {
    [WF_ITEM_LINE] = {"line", "points", "name series dashed"},
    [WF_ITEM_POINTS] = {"points", "points", "name series radius hollow dashed shades"},
    [WF_ITEM_LABEL] = {"label", "at text", "series radius"},
    [WF_ITEM_WORD] = {"word", "at text", "series anchor shift"},
    [WF_ITEM_RULE] = {"rule", "", "x y text"},
    [WF_ITEM_BAND] = {"band", "across", "text"},
    [WF_ITEM_BOXES] = {"boxes", "boxes", "series"},
    [WF_ITEM_MAP] = {"map", "box values", "range text"},
    [WF_ITEM_RING] = {"ring", "at", "text radius below dashed"},
};

static weft_status read_kind(reading *r, json_t *value, wf_plot_item *item) {
    const char *name = json_string_value(json_object_get(value, "kind"));
    wf_spelling spelling = {.text = name ? name : ""};
    char what[200];
    for (size_t k = 0; name && k < COUNT(kinds); k++) {
        wf_spelling_offer(&spelling, kinds[k].name);
        if (strcmp(kinds[k].name, name) != 0) continue;
        item->kind = (wf_plot_kind)k;
        return WEFT_OK;
    }
    size_t used = (size_t)snprintf(what, sizeof what, "kind: ");
    if (spelling.best) {
        snprintf(what + used, sizeof what - used, "'%.40s' is none; did you mean '%s'?", name,
                 spelling.best);
        return refuse(r, what);
    }
    for (size_t k = 0; k < COUNT(kinds); k++)
        used += (size_t)snprintf(what + used, sizeof what - used, "%s%s",
                                 k ? ", " : "it is one of ", kinds[k].name);
    return refuse(r, what);
}

/* Whether words, which blanks part, have one. */
static bool has_word(const char *words, const char *word) {
    size_t length = strlen(word);
    for (const char *at = words; (at = strstr(at, word)); at += length)
        if ((at == words || at[-1] == ' ') && (at[length] == ' ' || !at[length])) return true;
    return false;
}

static weft_status check_keys(reading *r, json_t *value, const wf_plot_item *item) {
    const char *needs = kinds[item->kind].needs, *may = kinds[item->kind].may, *key;
    json_t *member;
    char what[256], need[32];
    for (const char *at = needs; *at; at += strspn(at, " ")) {
        snprintf(need, sizeof need, "%.*s", (int)strcspn(at, " "), at);
        at += strlen(need);
        if (json_object_get(value, need)) continue;
        snprintf(what, sizeof what, "'%s' needs the key '%s'", kinds[item->kind].name, need);
        return refuse(r, what);
    }
    json_object_foreach(value, key, member) {
        size_t k = 0;
        while (k < COUNT(item_keys) && strcmp(item_keys[k].name, key)) k++;
        if (k == COUNT(item_keys) || !strcmp(key, "kind"))
            continue; /* told, and read, elsewhere */
        if (has_word(needs, key) || has_word(may, key)) continue;
        snprintf(what, sizeof what, "'%s' has no key '%s'; it takes %s%s%s",
                 kinds[item->kind].name, key, needs, *needs ? " " : "", may);
        return refuse(r, what);
    }
    return WEFT_OK;
}

/* A rule is at x or at y; shades are as many as points; a map without a range has its own. */
static weft_status settle_item(reading *r, json_t *value, wf_plot_item *item) {
    if (item->kind == WF_ITEM_RULE && !item->x == !item->y)
        return refuse(r, "a rule has either x or y");
    if (item->shade && json_array_size(json_object_get(value, "shades")) != item->points)
        return refuse(r, "there are not as many shades as points");
    if (item->kind != WF_ITEM_MAP || item->least < item->most) return WEFT_OK;
    item->least = item->most = item->value[0];
    for (size_t i = 0; i < item->rows * item->columns; i++) {
        item->least = fmin(item->least, item->value[i]);
        item->most = fmax(item->most, item->value[i]);
    }
    if (item->least == item->most) item->most = item->least + 1;
    return WEFT_OK;
}

static weft_status read_item(reading *r, json_t *value, wf_plot_item *item) {
    if (!json_is_object(value)) return refuse(r, "an object is wanted");
    weft_status status = read_kind(r, value, item);
    if (!status) status = check_keys(r, value, item);
    if (!status) status = read_object(r, value, item_keys, COUNT(item_keys), item);
    return status ? status : settle_item(r, value, item);
}

static weft_status read_items(reading *r, const key_row *row, json_t *value, void *object) {
    wf_plot_file *f = r->file;
    weft_status status = WEFT_OK;
    (void)row, (void)object;
    if (!json_is_array(value)) return refuse(r, "an array of objects is wanted");
    if (json_array_size(value) > WF_PLOT_MOST_ITEMS) return refuse(r, "at most 1000 are drawn");
    for (size_t i = 0; i < json_array_size(value) && !status; i++) {
        size_t length = enter(r, NULL, i);
        f->item[i] = (wf_plot_item){.kind = WF_ITEM_LINE};
        status = read_item(r, json_array_get(value, i), &f->item[i]);
        if (!status) leave(r, length);
    }
    f->panel.items = json_array_size(value);
    return status;
}

/* ---- The plot ---- */

#define PLOT(member) offsetof(wf_plot, member)

static const key_row plot_keys[] = {
    {"title", read_text, PLOT(title), 0, 0},
    {"subtitle", read_text, PLOT(subtitle), 0, 0},
    {"description", read_text, PLOT(description), 0, 0},
    {"width", read_whole, PLOT(width), 200, 8000},
    {"height", read_whole, PLOT(height), 150, 8000},
    {"x", read_axis, PLOT(x), 0, 0},
    {"y", read_y_axis, 0, 0, 0},
    {"items", read_items, 0, 0, 0},
};

static weft_status check_logs(reading *r) {
    const wf_plot_file *f = r->file;
    for (size_t i = 0; i < f->panel.items; i++) {
        const wf_plot_item *item = &f->item[i];
        for (size_t p = 0; p < item->points; p++) {
            bool x = f->plot.x.log && item->x && item->x[p] <= 0;
            if (!x && !(f->panel.y.log && item->y && item->y[p] <= 0)) continue;
            snprintf(r->where, sizeof r->where, "items[%zu]", i);
            return refuse(r, x ? "x is above 0 on a logarithmic axis"
                               : "y is above 0 on a logarithmic axis");
        }
    }
    return WEFT_OK;
}

static weft_status load(reading *r) {
    json_error_t why = {.line = -1};
    bool standard_input = !strcmp(r->path, "-");
    FILE *file = standard_input ? stdin : fopen(r->path, "rb");
    if (!file) return wf_fail(r->err, WEFT_FAILED, "%.300s: %s", r->path, strerror(errno));
    errno = 0;
    r->file->root = json_loadf(file, JSON_REJECT_DUPLICATES, &why);
    bool exhausted = errno == ENOMEM; /* which jansson may take for a fault of the text */
    bool unread = ferror(file);
    if (!standard_input) fclose(file);
    if (unread) return wf_fail(r->err, WEFT_FAILED, "%.300s: %s", r->path, strerror(EIO));
    if (r->file->root) return WEFT_OK;
    if (exhausted) return no_memory(r);
    return wf_fail(r->err, WEFT_USAGE, "%.300s: line %d, column %d: %s", r->path, why.line,
                   why.column, why.text);
}

weft_status wf_plot_file_read(const char *path, wf_plot_file *out, weft_error *err) {
    reading r = {.file = out, .path = path, .err = err};
    const wf_plot_axis axis = {.low = NAN, .high = NAN, .digits = -1};
    out->plot = (wf_plot){.look = WF_LOOK_PAGE, .x = axis, .panel = &out->panel, .panels = 1};
    out->panel = (wf_plot_panel){.y = axis, .item = out->item};
    out->root = NULL;
    out->array = NULL;
    out->arrays = 0;
    weft_status status = load(&r);
    if (!status) status = read_object(&r, out->root, plot_keys, COUNT(plot_keys), &out->plot);
    if (!status && !json_object_get(out->root, "items"))
        return refuse(&r, "the key 'items' is wanted: what to draw");
    return status ? status : check_logs(&r);
}

void wf_plot_file_free(wf_plot_file *file) {
    for (size_t i = 0; i < file->arrays; i++) free(file->array[i]);
    free(file->array);
    json_decref(file->root);
}
