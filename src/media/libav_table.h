// FFmpeg's entry points as a table that is filled when the first film is opened. Its libraries
// bring more than a hundred others; linked in, they would cost every command 30 ms before it
// begins.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/cpu.h>
#include <libavutil/dict.h>
#include <libavutil/frame.h>
#include <libavutil/log.h>
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

#include "core/shared_library.h"

namespace carom {

// clang-format off
/// Every function that carom calls: X(its name), by library.
#define CAROM_AVUTIL_FUNCTIONS(X)                                                                 \
    X(av_cpu_count) X(av_dict_free) X(av_dict_get) X(av_dict_set) X(av_frame_alloc)               \
    X(av_frame_free) X(av_frame_get_buffer) X(av_frame_make_writable) X(av_free)                  \
    X(av_get_cpu_flags) X(av_mallocz)                                                             \
    X(av_log_set_callback) X(av_opt_set) X(av_opt_set_double) X(av_opt_set_int)                   \
    X(av_pix_fmt_desc_get) X(av_rescale_q) X(av_strerror) X(av_version_info)
#define CAROM_AVCODEC_FUNCTIONS(X)                                                                \
    X(av_packet_alloc) X(av_packet_free) X(av_packet_free_side_data) X(av_packet_new_side_data)   \
    X(av_packet_rescale_ts) X(av_packet_unref)                                                    \
    X(avcodec_alloc_context3) X(avcodec_find_decoder) X(avcodec_find_decoder_by_name)             \
    X(avcodec_find_encoder_by_name)                                                               \
    X(avcodec_free_context) X(avcodec_open2)                                                      \
    X(avcodec_parameters_alloc) X(avcodec_parameters_copy) X(avcodec_parameters_free)             \
    X(avcodec_parameters_from_context)                                                            \
    X(avcodec_parameters_to_context) X(avcodec_receive_frame) X(avcodec_receive_packet)           \
    X(avcodec_send_frame) X(avcodec_send_packet) X(avcodec_version)
#define CAROM_AVFORMAT_FUNCTIONS(X)                                                               \
    X(av_find_best_stream) X(av_guess_format) X(av_interleaved_write_frame) X(av_read_frame)      \
    X(av_write_trailer) X(avformat_alloc_output_context2) X(avformat_close_input)                 \
    X(avformat_find_stream_info) X(avformat_free_context) X(avformat_new_stream)                  \
    X(avformat_open_input) X(avformat_version) X(avformat_write_header) X(avio_closep)            \
    X(avio_flush) X(avio_open)
#define CAROM_SWSCALE_FUNCTIONS(X)                                                                \
    X(sws_alloc_context) X(sws_freeContext) X(sws_getCoefficients) X(sws_init_context)              \
    X(sws_scale) X(sws_setColorspaceDetails) X(swscale_version)
// clang-format on

/// Each function under its own name.
struct Libav {
    CAROM_AVUTIL_FUNCTIONS(CAROM_FUNCTION)
    CAROM_AVCODEC_FUNCTIONS(CAROM_FUNCTION)
    CAROM_AVFORMAT_FUNCTIONS(CAROM_FUNCTION)
    CAROM_SWSCALE_FUNCTIONS(CAROM_FUNCTION)
};

/// Loads the libraries at the first call, of the versions that the headers belong to; they stay.
/// Failure(kRun) with the loader's own text if one is missing. Safe from any thread.
const Libav& libav();

}  // namespace carom
