/* A renderer in few lines that writes a sample buffer: a disc that moves over a gradient, 64
 * samples a pixel and frame at random, in a deep EXR file that weft converts.
 *   cc write_samples.c $(pkg-config --cflags --libs OpenEXR) -o write_samples
 *   ./write_samples disc.0000.exr 0 180 122
 *   weft convert disc.0000.exr --raster 180x122@30i -o disc.png */
#include <openexr.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { B, G, R, T, X, Y, CHANNELS, EACH = 64 };
static const char *const names[CHANNELS] = {"B", "G", "R", "sample.t", "sample.x", "sample.y"};

static float drawn(void) { return (float)rand() / ((float)RAND_MAX + 1); }

/* What is seen at x, y (pixels and lines) at t (field periods from the first field). */
static void look(float x, float y, float t, float width, float lines, float rgb[3]) {
    float u = x / width - 0.3f - 0.01f * t, v = (y / lines - 0.5f) * lines / width;
    int disc = u * u + v * v < 0.02f;
    rgb[0] = disc ? 0.9f : 0.2f * y / lines;
    rgb[1] = disc ? 0.3f : 0.3f * y / lines;
    rgb[2] = disc ? 0.1f : 0.5f;
}

int main(int argc, char **argv) {
    if (argc != 5) return fprintf(stderr, "usage: write_samples FILE FRAME WIDTH LINES\n"), 2;
    int frame = atoi(argv[2]), width = atoi(argv[3]), lines = atoi(argv[4]);
    exr_context_t exr;
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_attr_box2i_t window = {{.x = 0, .y = 0}, {.x = width - 1, .y = lines - 1}};
    exr_attr_v2f_t center = {.x = 0, .y = 0};
    int bad = exr_start_write(&exr, argv[1], EXR_WRITE_FILE_DIRECTLY, &how);
    if (bad) return 1;
    bad |= exr_add_part(exr, "samples", EXR_STORAGE_DEEP_SCANLINE, NULL);
    bad |= exr_initialize_required_attr(exr, 0, &window, &window, 1, &center, 1,
                                        EXR_LINEORDER_INCREASING_Y, EXR_COMPRESSION_NONE);
    for (int c = 0; c < CHANNELS; c++)
        bad |= exr_add_channel(exr, 0, names[c], EXR_PIXEL_FLOAT, EXR_PERCEPTUALLY_LINEAR, 1, 1);
    bad |= exr_write_header(exr);
    size_t samples = (size_t)width * EACH, bytes = CHANNELS * samples * sizeof(float);
    float *line = malloc(bytes), rgb[3];
    int32_t *upto = malloc((size_t)width * sizeof *upto);
    for (int j = 0; line && upto && j < lines; j++) {
        for (size_t k = 0; k < samples; k++) {
            float x = (float)(k / EACH) + drawn(), y = (float)j + drawn(), t = 2 * drawn();
            look(x, y, 2.0f * (float)frame + t, (float)width, (float)lines, rgb);
            const float sample[CHANNELS] = {rgb[2], rgb[1], rgb[0], t, x, y};
            for (int c = 0; c < CHANNELS; c++) line[(size_t)c * samples + k] = sample[c];
        }
        for (int i = 0; i < width; i++) upto[i] = (i + 1) * EACH; /* cumulative */
        bad |= exr_write_deep_scanline_chunk(exr, 0, j, line, bytes, bytes, upto,
                                             (size_t)width * sizeof *upto);
    }
    return exr_finish(&exr) || bad || !line || !upto;
}
