/* How far a picture is from a truth: bench-compare TRUTH PICTURE [BOUND]. Prints the RMS of the
 * difference of display-encoded values (Rec. 709), and with a bound the share of pixels whose
 * RMS over their channels lies within it. A truth of several pictures, comma between them, is
 * their mean; then what is printed third is its own uncertainty. Fourth is the light of the
 * picture beside that of the truth, and fifth the share of pixels that lie within the bound and
 * three times the truth's uncertainty. Where the truth is below 0 nothing is known, and compared.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/read/picture.h"

#define MOST 8

static double encoded(double v) {
    double size = fabs(v);
    double code = size < 0.018 ? 4.5 * size : 1.099 * pow(size, 0.45) - 0.099;
    return v < 0 ? -code : code;
}

static wf_image load(const char *path) {
    wf_image image;
    char why[1000];
    if (wf_picture_load(NULL, path, false, &image, why, sizeof why)) return image;
    fprintf(stderr, "bench-compare: %s\n", why);
    exit(1);
}

static int load_all(char *paths, wf_image *out) {
    int count = 0;
    for (char *path = strtok(paths, ","); path && count < MOST; path = strtok(NULL, ","))
        out[count++] = load(path);
    return count;
}

static double mean_of(const wf_image *all, int count, size_t at) {
    double sum = 0;
    for (int n = 0; n < count; n++) sum += (double)all[n].rgb[at];
    return sum / count;
}

/* Of the mean of several: from how far they lie apart. */
static double uncertainty(const wf_image *all, int count, size_t values) {
    double sum = 0;
    for (size_t at = 0; at < values; at++) {
        double mean = encoded(mean_of(all, count, at));
        for (int n = 0; n < count; n++) {
            double apart = encoded((double)all[n].rgb[at]) - mean;
            sum += apart * apart;
        }
    }
    return count > 1 ? sqrt(sum / (double)values / (count * (count - 1.0))) : 0;
}

/* The mean of all values beside that of the truth's. */
static double light_beside(const wf_image *all, int count, const wf_image *is, size_t values) {
    double truth = 0, own = 0;
    for (size_t at = 0; at < values; at++) {
        double here = mean_of(all, count, at);
        truth += here > 0 ? here : 0;
        own += here >= 0 ? (double)is->rgb[at] : 0;
    }
    return truth > 0 ? own / truth : 1;
}

int main(int argc, char **argv) {
    wf_image truth[MOST];
    if (argc < 3) {
        fprintf(stderr, "usage: bench-compare TRUTH[,TRUTH..] PICTURE [BOUND]\n");
        return 2;
    }
    int count = load_all(argv[1], truth);
    wf_image is = load(argv[2]);
    double bound = argc > 3 ? atof(argv[3]) : HUGE_VAL, square = 0;
    size_t pixels = (size_t)is.width_px * (size_t)is.height_px, within = 0, near = 0, known = 0;
    bool alike = count > 0;
    for (int n = 0; n < count; n++)
        alike &= truth[n].width_px == is.width_px && truth[n].height_px == is.height_px;
    if (!alike) {
        fprintf(stderr, "bench-compare: %s and %s differ in size\n", argv[1], argv[2]);
        return 1;
    }
    double unsure = uncertainty(truth, count, 3 * pixels);
    for (size_t i = 0; i < pixels; i++) {
        double own = 0;
        if (mean_of(truth, count, 3 * i) < 0) continue;
        known++;
        for (size_t at = 3 * i; at < 3 * i + 3; at++) {
            double e = encoded((double)is.rgb[at]) - encoded(mean_of(truth, count, at));
            own += e * e / 3;
        }
        square += own;
        within += sqrt(own) <= bound;
        near += sqrt(own) <= bound + 3 * unsure;
    }
    printf("%.6g %.6f %.6g %.6f %.6f\n", sqrt(square / (double)known),
           (double)within / (double)known, unsure, light_beside(truth, count, &is, 3 * pixels),
           (double)near / (double)known);
    for (int n = 0; n < count; n++) free(truth[n].rgb);
    free(is.rgb);
    return 0;
}
