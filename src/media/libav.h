// What the files of this folder share of FFmpeg's libraries: owners of its objects, its messages as
// Failures. Only .cpp files include it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/failure.h"
#include "media/libav_table.h"

namespace carom {

struct LibavFree {
    void operator()(AVCodecContext* p) const { libav().avcodec_free_context(&p); }
    void operator()(AVCodecParameters* p) const { libav().avcodec_parameters_free(&p); }
    void operator()(AVFrame* p) const { libav().av_frame_free(&p); }
    void operator()(AVPacket* p) const { libav().av_packet_free(&p); }
    void operator()(SwsContext* p) const { libav().sws_freeContext(p); }
};
using CodecPtr = std::unique_ptr<AVCodecContext, LibavFree>;
using ParametersPtr = std::unique_ptr<AVCodecParameters, LibavFree>;
using FramePtr = std::unique_ptr<AVFrame, LibavFree>;
using PacketPtr = std::unique_ptr<AVPacket, LibavFree>;
using ScalerPtr = std::unique_ptr<SwsContext, LibavFree>;

/// Collects what FFmpeg and x264 have to say about errors on this thread while it lives; scopes
/// nest. The first one turns FFmpeg's own printing to standard error off for the whole process:
/// what matters goes into a Failure.
class LibavMessages {
  public:
    LibavMessages();
    ~LibavMessages();
    LibavMessages(const LibavMessages&) = delete;
    LibavMessages& operator=(const LibavMessages&) = delete;

    /// "; message; message", or "".
    std::string text() const;

  private:
    static void receive(void* context, int level, const char* format, va_list arguments);

    std::vector<std::string> lines_;
    LibavMessages* outer_;
};

/// Throws Failure(kind): "cannot <action> '<path>': <text of code>; <messages>".
[[noreturn]] void throw_libav(FailureKind kind, const std::string& action, const std::string& path,
                              int code, const LibavMessages& messages);

/// Throws std::bad_alloc when one of FFmpeg's allocating functions gave nothing.
template <class T>
T* allocated(T* pointer) {
    if (pointer == nullptr) throw std::bad_alloc();
    return pointer;
}

/// FFmpeg would take what stands before a colon in a name for a protocol.
std::string libav_url(const std::string& path);

}  // namespace carom
