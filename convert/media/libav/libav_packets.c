/* Counts the packets of a file: how many pictures, of which kind and how large, how much sound.
 */
#include "convert/media/libav/libav_packets.h"

#include <stdlib.h>

typedef struct sound_length {
    double seconds; /* of its packets */
    double longest_s;
} sound_length;

typedef struct counting {
    AVFormatContext *format;
    const AVStream *stream;
    AVCodecContext *codec, *parsed; /* that decodes; that the parser writes to */
    AVCodecParserContext *parser;   /* NULL: the codec has none */
    AVFrame *frame;
    bool have_frame;
    int64_t since_whole; /* pictures since one that needs no other */
    sound_length *sound; /* [streams] */
    unsigned streams;    /* at first; transport streams may show others on the way */
    wf_contents *there;
} counting;

static bool open_codec(counting *c) {
    const AVCodecParameters *p = c->stream->codecpar;
    const AVCodec *decoder = avcodec_find_decoder(p->codec_id);
    c->codec = avcodec_alloc_context3(decoder);
    c->parser = av_parser_init((int)p->codec_id);
    if (c->parser) c->parser->flags |= PARSER_FLAG_COMPLETE_FRAMES;
    c->parsed = avcodec_alloc_context3(decoder);
    if (!c->codec || !c->parsed || avcodec_parameters_to_context(c->codec, p) < 0 ||
        avcodec_parameters_to_context(c->parsed, p) < 0)
        return false;
    c->have_frame = !decoder || avcodec_open2(c->codec, decoder, NULL) < 0; /* none comes */
    return true;
}

/* Fields that a packet is shown for: 1 of a field, 3 of a frame whose first field is repeated.
 */
static int fields_of(counting *c, const AVPacket *p, enum AVPictureType *type) {
    enum AVCodecID id = c->stream->codecpar->codec_id;
    uint8_t *data;
    int bytes;
    *type = p->flags & AV_PKT_FLAG_KEY ? AV_PICTURE_TYPE_I : AV_PICTURE_TYPE_NONE;
    if (!c->parser || (id != AV_CODEC_ID_MPEG2VIDEO && id != AV_CODEC_ID_H264)) return 2;
    av_parser_parse2(c->parser, c->parsed, &data, &bytes, p->data, p->size, p->pts, p->dts,
                     p->pos);
    *type = (enum AVPictureType)c->parser->pict_type;
    return c->parser->repeat_pict < 0 ? 2 : 1 + c->parser->repeat_pict;
}

static void note_type(counting *c, enum AVPictureType type) {
    wf_contents *t = c->there;
    t->types_known |= type != AV_PICTURE_TYPE_NONE;
    t->whole += type == AV_PICTURE_TYPE_I;
    t->between += type == AV_PICTURE_TYPE_B;
    c->since_whole = type == AV_PICTURE_TYPE_I ? 1 : c->since_whole + 1;
    if (c->since_whole > t->longest_group) t->longest_group = c->since_whole;
}

static void count_picture(counting *c, const AVPacket *p) {
    wf_contents *t = c->there;
    enum AVPictureType type;
    int fields = fields_of(c, p, &type);
    t->fields += fields;
    t->lone_fields += fields == 1;
    t->hidden += (p->flags & AV_PKT_FLAG_DISCARD) != 0;
    t->repeated += fields > 2;
    t->bytes += p->size;
    if (!t->packets || p->size < t->least_bytes) t->least_bytes = p->size;
    if (p->size > t->most_bytes) t->most_bytes = p->size;
    t->packets++;
    note_type(c, type);
    if (!c->have_frame && avcodec_send_packet(c->codec, p) >= 0)
        c->have_frame = avcodec_receive_frame(c->codec, c->frame) >= 0;
}

static void count_sound(counting *c, const AVPacket *p) {
    sound_length *s = &c->sound[p->stream_index];
    double seconds =
        (double)p->duration * av_q2d(c->format->streams[p->stream_index]->time_base);
    if (!(seconds > 0) || p->flags & AV_PKT_FLAG_DISCARD) return;
    s->seconds += seconds;
    if (seconds > s->longest_s) s->longest_s = seconds;
}

/* Sound that is coded comes in blocks, of which a part of the first and the last is not heard.
 */
static void sum_sound(counting *c) {
    wf_contents *t = c->there;
    for (unsigned i = 0; i < c->streams; i++) {
        const AVStream *s = c->format->streams[i];
        if (s->codecpar->codec_type != AVMEDIA_TYPE_AUDIO) continue;
        bool pcm = av_get_exact_bits_per_sample(s->codecpar->codec_id) > 0;
        double seconds = c->sound[i].seconds, block_s = pcm ? 0 : 2 * c->sound[i].longest_s;
        if (!t->sounds || seconds < t->sound_least_s) t->sound_least_s = seconds;
        if (seconds > t->sound_most_s) t->sound_most_s = seconds;
        if (block_s > t->sound_block_s) t->sound_block_s = block_s;
        t->sounds++;
    }
}

static void count_all(counting *c) {
    AVPacket *packet = av_packet_alloc();
    int code = packet ? 0 : AVERROR(ENOMEM);
    while (code >= 0 && (code = av_read_frame(c->format, packet)) >= 0) {
        const AVStream *s = c->format->streams[packet->stream_index];
        if (s == c->stream)
            count_picture(c, packet);
        else if (s->codecpar->codec_type == AVMEDIA_TYPE_AUDIO &&
                 packet->stream_index < (int)c->streams)
            count_sound(c, packet);
        av_packet_unref(packet);
    }
    av_packet_free(&packet);
    if (!c->have_frame && avcodec_send_packet(c->codec, NULL) >= 0)
        c->have_frame = avcodec_receive_frame(c->codec, c->frame) >= 0;
}

int wf_libav_packets(AVFormatContext *format, int stream, wf_metadata *metadata,
                     AVFrame *frame) {
    counting c = {.format = format,
                  .stream = format->streams[stream],
                  .frame = frame,
                  .streams = format->nb_streams,
                  .there = &metadata->there};
    c.sound = calloc(c.streams, sizeof *c.sound);
    bool fits = c.sound && open_codec(&c);
    if (fits) count_all(&c);
    if (fits) sum_sound(&c);
    av_parser_close(c.parser);
    avcodec_free_context(&c.codec);
    avcodec_free_context(&c.parsed);
    free(c.sound);
    return fits ? 0 : AVERROR(ENOMEM);
}
