#ifndef WF_CONVERT_READ_CHOICE_LAYERS_H
#define WF_CONVERT_READ_CHOICE_LAYERS_H

#include <stdbool.h>
#include <stddef.h>

/* Layers of the parts of a file: channels whose names begin alike. */

/* A channel, as far as the choice of a picture goes. */
typedef struct wf_channel {
    const char *name;   /* "R", "diffuse.R" */
    bool whole_numbers; /* of 32 bits: an id, never a picture */
    bool ids;           /* of a Cryptomatte that the header names */
} wf_channel;

/* A part of a file. Files of one part, and other formats, are one part without a name. */
typedef struct wf_part {
    const char *name; /* "": none */
    const wf_channel *channel;
    int count;
    bool flat; /* false: deep, and no picture */
} wf_part;

/* Channels of a part that share a prefix. */
typedef struct wf_layer {
    const wf_part *part;
    int number; /* of the part, from 0 */
    int lead;   /* its first channel, whose name begins with the prefix: */
    const char *name;
    size_t length; /* of the prefix; 0: it has none */
} wf_layer;

typedef struct wf_layers {
    wf_layer *of; /* [count], owned: free() */
    int count;
} wf_layers;

/* Length of the layer part of a channel's name: 7 of "diffuse.R", 0 of "R"; and what follows
 * it. */
size_t wf_layer_length(const char *name);
const char *wf_layer_base(const char *name);

/* Finds the layers of all parts, in their order. False when memory is out. */
bool wf_layers_find(const wf_part *parts, int count, wf_layers *all);

typedef enum wf_picture_kind {
    WF_PICTURE_RGB,              /* R G B, or red, green, blue, in any case */
    WF_PICTURE_Y,                /* Y alone, in a layer with neither X nor Z, U nor V */
    WF_PICTURE_LUMINANCE_CHROMA, /* Y RY BY, of OpenEXR's luminance-chroma images */
    WF_PICTURE_KINDS
} wf_picture_kind;

/* "R G B", "Y", "Y RY BY". */
const char *wf_picture_kind_name(wf_picture_kind kind);

/* Which channels of a layer make a picture of a kind (Y: the same three times). False: none. */
bool wf_layer_channels(const wf_layer *layer, wf_picture_kind kind, int channel[3]);

/* Its alpha: A or alpha; of a layer named as the beauty else that without a prefix. -1: none.
 */
int wf_layer_alpha(const wf_layer *layer);

/* Whether it is Cryptomatte; and whether it is that or is named as depth, a vector or an id. */
bool wf_layer_holds_ids(const wf_layer *layer);
bool wf_layer_is_data(const wf_layer *layer);

/* Names that renderers give to the beauty: which of them this is, the likeliest first, or
 * WF_BEAUTIES: none. "View.Combined" is "Combined". Case does not matter. */
#define WF_BEAUTIES 6
size_t wf_beauty_of(const char *name, size_t length);

/* All parts and their layers as text: "part 0 'depth': Z; part 1 'rgba': R G B A, N (X Y Z)".
 * What does not fit is counted. */
void wf_list_layers(const wf_part *parts, int count, char *text, size_t size);

/* Calls tell for every layer of every part; channels are blank separated, without the prefix.
 */
typedef void wf_layer_fn(void *user, int part, const char *part_name, const char *layer,
                         const char *channels);
void wf_each_layer(const wf_part *parts, int count, wf_layer_fn *tell, void *user);

#endif
