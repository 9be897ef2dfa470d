/* Builds MXF in memory: keys, lengths and values, local sets, the primer. */
#include "convert/write/mxf_klv.h"

#include <stdlib.h>
#include <string.h>

#include "convert/base/big_endian.h"

#define BER_BYTES 4

/* ---- Bytes ---- */

static bool make_room(wf_bytes *b, size_t more) {
    if (b->failed) return false;
    if (b->capacity - b->size >= more) return true;
    size_t capacity = 2 * (b->size + more) + 4096;
    uint8_t *data = realloc(b->data, capacity);
    if (!data) return !(b->failed = true);
    b->data = data;
    b->capacity = capacity;
    return true;
}

void wf_bytes_put(wf_bytes *b, const void *data, size_t size) {
    if (!size || !make_room(b, size)) return;
    memcpy(b->data + b->size, data, size);
    b->size += size;
}

void wf_bytes_number(wf_bytes *b, int size, uint64_t value) {
    uint8_t bytes[8];
    wf_put_big_endian(bytes, value, (size_t)size);
    wf_bytes_put(b, bytes, (size_t)size);
}

void wf_bytes_ul(wf_bytes *b, wf_ul ul) {
    wf_bytes_number(b, 8, ul.high);
    wf_bytes_number(b, 8, ul.low);
}

/* ---- Key, length, value ---- */

size_t wf_klv_begin(wf_bytes *b, wf_ul key) {
    wf_bytes_ul(b, key);
    wf_bytes_number(b, BER_BYTES, 0x83000000);
    return b->size;
}

void wf_klv_end(wf_bytes *b, size_t begun) {
    if (b->failed) return;
    size_t length = b->size - begun;
    for (size_t i = 1; i < BER_BYTES; i++)
        b->data[begun - i] = (uint8_t)(length >> 8 * (i - 1) & 255);
}

void wf_klv_fill_to(wf_bytes *b, size_t end) {
    static const wf_ul fill = {0x060e2b3401010102, 0x0301021001000000};
    size_t begun = wf_klv_begin(b, fill), zeros = end - b->size;
    if (!make_room(b, zeros)) return;
    memset(b->data + b->size, 0, zeros);
    b->size += zeros;
    wf_klv_end(b, begun);
}

void wf_klv_fill(wf_bytes *b, size_t grid) {
    if (b->size % grid == 0) return;
    wf_klv_fill_to(b, (b->size + WF_KLV_FILL_LEAST + grid - 1) / grid * grid);
}

/* ---- Items ---- */

static void tag_and_length(wf_bytes *b, uint16_t tag, size_t length) {
    wf_bytes_number(b, 2, tag);
    wf_bytes_number(b, 2, length);
}

void wf_item_bytes(wf_bytes *b, uint16_t tag, const void *data, size_t size) {
    tag_and_length(b, tag, size);
    wf_bytes_put(b, data, size);
}

void wf_item_number(wf_bytes *b, uint16_t tag, int size, uint64_t value) {
    tag_and_length(b, tag, (size_t)size);
    wf_bytes_number(b, size, value);
}

void wf_item_rational(wf_bytes *b, uint16_t tag, wf_rational value) {
    tag_and_length(b, tag, 8);
    wf_bytes_number(b, 4, (uint64_t)value.num);
    wf_bytes_number(b, 4, (uint64_t)value.den);
}

void wf_item_ul(wf_bytes *b, uint16_t tag, wf_ul value) {
    tag_and_length(b, tag, 16);
    wf_bytes_ul(b, value);
}

void wf_item_uid(wf_bytes *b, uint16_t tag, wf_uid value) {
    wf_item_bytes(b, tag, value.byte, sizeof value.byte);
}

void wf_item_text(wf_bytes *b, uint16_t tag, const char *ascii) {
    size_t length = strlen(ascii);
    tag_and_length(b, tag, 2 * length);
    for (size_t i = 0; i < length; i++) wf_bytes_number(b, 2, (uint8_t)ascii[i]);
}

void wf_item_array(wf_bytes *b, uint16_t tag, uint32_t count, uint32_t element_bytes) {
    tag_and_length(b, tag, 8 + (size_t)count * element_bytes);
    wf_bytes_number(b, 4, count);
    wf_bytes_number(b, 4, element_bytes);
}

/* ---- Primer ---- */

/* Items by their static tags: the version of the registry (RP 210) that has them, and the last
 * eight bytes of their labels. */
static const struct {
    uint16_t tag;
    uint8_t version;
    uint64_t low;
} items[] = {
    {0x3c0a, 1, 0x0101150200000000}, /* InstanceUID */
    /* Preface */
    {0x3b02, 2, 0x0702011002040000}, /* LastModifiedDate */
    {0x3b05, 2, 0x0301020105000000}, /* Version */
    {0x3b06, 2, 0x0601010406040000}, /* Identifications */
    {0x3b03, 2, 0x0601010402010000}, /* ContentStorage */
    {0x3b09, 5, 0x0102020300000000}, /* OperationalPattern */
    {0x3b0a, 5, 0x0102021002010000}, /* EssenceContainers */
    {0x3b0b, 5, 0x0102021002020000}, /* DMSchemes */
    /* Identification */
    {0x3c09, 2, 0x0520070101000000}, /* ThisGenerationUID */
    {0x3c01, 2, 0x0520070102010000}, /* CompanyName */
    {0x3c02, 2, 0x0520070103010000}, /* ProductName */
    {0x3c03, 2, 0x0520070104000000}, /* ProductVersion */
    {0x3c04, 2, 0x0520070105010000}, /* VersionString */
    {0x3c05, 2, 0x0520070107000000}, /* ProductUID */
    {0x3c06, 2, 0x0702011002030000}, /* ModificationDate */
    /* ContentStorage, EssenceContainerData */
    {0x1901, 2, 0x0601010405010000}, /* Packages */
    {0x1902, 2, 0x0601010405020000}, /* EssenceContainerData */
    {0x2701, 2, 0x0601010601000000}, /* LinkedPackageUID */
    {0x3f06, 4, 0x0103040500000000}, /* IndexSID */
    {0x3f07, 4, 0x0103040400000000}, /* BodySID */
    /* Packages */
    {0x4401, 1, 0x0101151000000000}, /* PackageUID */
    {0x4402, 1, 0x0103030201000000}, /* PackageName */
    {0x4405, 2, 0x0702011001030000}, /* PackageCreationDate */
    {0x4404, 2, 0x0702011002050000}, /* PackageModifiedDate */
    {0x4403, 2, 0x0601010406050000}, /* Tracks */
    {0x4701, 2, 0x0601010402030000}, /* Descriptor */
    /* Tracks */
    {0x4801, 2, 0x0107010100000000}, /* TrackID */
    {0x4804, 2, 0x0104010300000000}, /* TrackNumber */
    {0x4802, 2, 0x0107010201000000}, /* TrackName */
    {0x4803, 2, 0x0601010402040000}, /* Sequence */
    {0x4b01, 2, 0x0530040500000000}, /* EditRate */
    {0x4b02, 2, 0x0702010301030000}, /* Origin */
    /* Structural components */
    {0x0201, 2, 0x0407010000000000}, /* DataDefinition */
    {0x0202, 2, 0x0702020101030000}, /* Duration */
    {0x1001, 2, 0x0601010406090000}, /* StructuralComponents */
    {0x1201, 2, 0x0702010301040000}, /* StartPosition */
    {0x1101, 2, 0x0601010301000000}, /* SourcePackageID */
    {0x1102, 2, 0x0601010302000000}, /* SourceTrackID */
    {0x1501, 2, 0x0702010301050000}, /* StartTimecode */
    {0x1502, 2, 0x0404010102060000}, /* RoundedTimecodeBase */
    {0x1503, 1, 0x0404010105000000}, /* DropFrame */
    /* File descriptors */
    {0x3006, 5, 0x0601010305000000}, /* LinkedTrackID */
    {0x3001, 1, 0x0406010100000000}, /* SampleRate */
    {0x3002, 1, 0x0406010200000000}, /* ContainerDuration */
    {0x3004, 2, 0x0601010401020000}, /* EssenceContainer */
    {0x3f01, 4, 0x06010104060b0000}, /* SubDescriptorUIDs */
    /* Picture descriptors */
    {0x3201, 2, 0x0401060100000000}, /* PictureEssenceCoding */
    {0x3215, 5, 0x0405011300000000}, /* SignalStandard */
    {0x320c, 1, 0x0401030104000000}, /* FrameLayout */
    {0x3202, 1, 0x0401050201000000}, /* StoredHeight */
    {0x3203, 1, 0x0401050202000000}, /* StoredWidth */
    {0x3204, 1, 0x0401050107000000}, /* SampledHeight */
    {0x3205, 1, 0x0401050108000000}, /* SampledWidth */
    {0x3206, 1, 0x0401050109000000}, /* SampledXOffset */
    {0x3207, 1, 0x040105010a000000}, /* SampledYOffset */
    {0x3208, 1, 0x040105010b000000}, /* DisplayHeight */
    {0x3209, 1, 0x040105010c000000}, /* DisplayWidth */
    {0x320a, 1, 0x040105010d000000}, /* DisplayXOffset */
    {0x320b, 1, 0x040105010e000000}, /* DisplayYOffset */
    {0x320e, 1, 0x0401010101000000}, /* AspectRatio */
    {0x320d, 2, 0x0401030205000000}, /* VideoLineMap */
    {0x3210, 2, 0x0401020101010200}, /* TransferCharacteristic */
    {0x3212, 2, 0x0401030106000000}, /* FieldDominance */
    {0x3219, 9, 0x0401020101060100}, /* ColorPrimaries */
    {0x321a, 2, 0x0401020101030100}, /* CodingEquations */
    {0x3301, 2, 0x040105030a000000}, /* ComponentDepth */
    {0x3302, 1, 0x0401050105000000}, /* HorizontalSubsampling */
    {0x3308, 2, 0x0401050110000000}, /* VerticalSubsampling */
    {0x3303, 1, 0x0401050106000000}, /* ColorSiting */
    {0x3304, 1, 0x0401050303000000}, /* BlackRefLevel */
    {0x3305, 1, 0x0401050304000000}, /* WhiteRefLevel */
    {0x3306, 2, 0x0401050305000000}, /* ColorRange */
    /* Sound descriptors */
    {0x3d03, 5, 0x0402030101010000}, /* AudioSamplingRate */
    {0x3d02, 4, 0x0402030104000000}, /* Locked */
    {0x3d07, 5, 0x0402010104000000}, /* ChannelCount */
    {0x3d01, 4, 0x0402030304000000}, /* QuantizationBits */
    {0x3d0a, 5, 0x0402030201000000}, /* BlockAlign */
    {0x3d09, 5, 0x0402030305000000}, /* AvgBps */
    /* Index table segment */
    {0x3f05, 4, 0x0406020100000000}, /* EditUnitByteCount */
    {0x3f08, 4, 0x0404040101000000}, /* SliceCount */
    {0x3f09, 5, 0x0404040106000000}, /* DeltaEntryArray */
    {0x3f0b, 5, 0x0530040600000000}, /* IndexEditRate */
    {0x3f0c, 5, 0x07020103010a0000}, /* IndexStartPosition */
    {0x3f0d, 5, 0x0702020101020000}, /* IndexDuration */
};

void wf_klv_primer(wf_bytes *b) {
    static const wf_ul key = WF_UL_PACK(0x0d01020101050100);
    const size_t count = sizeof items / sizeof *items;
    size_t begun = wf_klv_begin(b, key);
    wf_bytes_number(b, 4, count);
    wf_bytes_number(b, 4, 18);
    for (size_t i = 0; i < count; i++) {
        wf_bytes_number(b, 2, items[i].tag);
        wf_bytes_ul(b, (wf_ul){0x060e2b3401010100 | items[i].version, items[i].low});
    }
    wf_klv_end(b, begun);
}
