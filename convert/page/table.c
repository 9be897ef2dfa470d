/* The table of what is measured of a page's clips. */
#include <math.h>
#include <string.h>

#include "convert/page/parts.h"

/* What to call a group of figures, and its key in the table of figures. */
static const struct {
    const char *group, *title;
} groups[] = {{"flicker", "Interline flicker"}, {"flicker.visible", "Flicker that is seen"},
              {"crawl", "Crawl of edges"},      {"sharpness", "Sharpness"},
              {"cross_color", "Cross-color"},   {"cross_luma", "Cross-luma"},
              {"order", "Field order"},         {"legal", "Legality"},
              {"difference", "Difference"}};

static const char *title_of(const char *group) {
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
        if (!strcmp(groups[i].group, group)) return groups[i].title;
    return group;
}

static bool is_share(const wf_figure_kind *kind) {
    const char *end = kind->key ? strstr(kind->key, "share") : NULL;
    return (end && !end[5]) || (kind->key && !strcmp(kind->key, "agreement"));
}

static bool is_judged(const wf_figure_kind *kind) {
    return strcmp(kind->group, "order") != 0;
}

/* The best of a row, where clips differ in it by a part in a hundred; NaN: none is. */
static double best_of(const wf_page *page, const wf_figure_kind *kind) {
    double best = NAN, worst = NAN;
    if (!is_judged(kind)) return NAN;
    for (size_t i = 0; i < page->clips; i++) {
        double value = wf_figure_value(&page->clip[i].figures, kind);
        if (isnan(value)) continue;
        best = isnan(best) || (value < best) != kind->more_better ? value : best;
        worst = isnan(worst) || (value > worst) != kind->more_better ? value : worst;
    }
    return fabs(best - worst) > 0.01 * fabs(worst) ? best : NAN;
}

static void add_value(wf_text *text, const wf_figure_kind *kind, double value, double best) {
    const char *open = value == best ? "<b>" : "", *close = value == best ? "</b>" : "";
    if (isnan(value))
        wf_text_add(text, "<td>–</td>");
    else if (is_share(kind))
        wf_text_add(text, "<td>%s%.3g %%%s</td>", open, 100 * value, close);
    else
        wf_text_add(text, "<td>%s%.3g%s</td>", open, value, close);
}

static bool is_measured(const wf_page *page, const wf_figure_kind *kind) {
    for (size_t i = 0; i < page->clips; i++)
        if (!isnan(wf_figure_value(&page->clip[i].figures, kind))) return true;
    return false;
}

static void add_group(wf_text *text, const wf_page *page, const char *group) {
    wf_text_add(text,
                "<tr class=\"group\"><th scope=\"colgroup\" colspan=\"%zu\">%s</th></tr>\n",
                page->clips + 1, title_of(group));
    if (strcmp(group, "order") != 0) return;
    wf_text_add(text, "<tr><th scope=\"row\">what the pixels say</th>");
    for (size_t i = 0; i < page->clips; i++) {
        const char *verdict = page->clip[i].figures.order_verdict;
        wf_text_add(text, "<td>%s</td>", verdict ? verdict : "–");
    }
    wf_text_add(text, "</tr>\n");
}

static void add_row(wf_text *text, const wf_page *page, const wf_figure_kind *kind) {
    double best = best_of(page, kind);
    wf_text_add(text, "<tr><th scope=\"row\">");
    wf_text_add_words(text, kind->help);
    wf_text_add(text, " <code>%s%s%s</code></th>", kind->group, kind->key ? "." : "",
                kind->key ? kind->key : "");
    for (size_t i = 0; i < page->clips; i++)
        add_value(text, kind, wf_figure_value(&page->clip[i].figures, kind), best);
    wf_text_add(text, "</tr>\n");
}

void wf_page_table(wf_text *text, const wf_page *page) {
    const wf_figure_kind *kind;
    const char *open = "";
    wf_text_add(text, "<div class=\"scroll\" tabindex=\"0\" role=\"region\" "
                      "aria-label=\"Measures\"><table class=\"measures\"><thead><tr>"
                      "<th scope=\"col\">Measure</th>");
    for (size_t i = 0; i < page->clips; i++) {
        wf_text_add(text, "<th scope=\"col\">");
        wf_text_add_words(text, page->clip[i].label);
        wf_text_add(text, "</th>");
    }
    wf_text_add(text, "</tr></thead><tbody>\n");
    for (size_t i = 0; (kind = wf_figure_at(i)); i++) {
        if (!is_measured(page, kind)) continue;
        if (strcmp(open, kind->group) != 0) add_group(text, page, kind->group);
        open = kind->group;
        add_row(text, page, kind);
    }
    wf_text_add(text, "</tbody></table></div>");
}
