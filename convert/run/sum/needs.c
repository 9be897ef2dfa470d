/* From what fields need to the units that are read for them, in the order of time. The run and
 * its dry run walk alike. */
#include "convert/run/sum/needs.h"

#include "convert/run/sum/flow.h"

wf_walk wf_walk_begin(void) {
    return (wf_walk){.next_unit = INT64_MIN};
}

int64_t wf_walk_group_end(const wf_run *run, int64_t field, int64_t past) {
    int64_t end = field + run->pace.fields_together;
    return end < past ? end : past;
}

void wf_walk_group(const wf_run *run, wf_walk *walk, int64_t first, int64_t end) {
    walk->field = first;
    walk->group_end = end;
    if (!run->pace.fields_carried) walk->next_unit = INT64_MIN;
}

bool wf_walk_units(const wf_run *run, wf_walk *walk, wf_units *units) {
    units->count = 0;
    units->group_end = walk->group_end;
    while (walk->field < walk->group_end && units->count < run->pace.units_together) {
        wf_needs needs = run->kind->needs(run, walk->field);
        if (walk->next_unit < needs.first) walk->next_unit = needs.first;
        if (walk->next_unit >= needs.end)
            walk->field++;
        else
            units->unit[units->count++] = walk->next_unit++;
    }
    return units->count > 0;
}
