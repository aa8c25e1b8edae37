#include "media/film_input.h"

#include <utility>

namespace carom {

namespace {

std::string text_of(const AVDictionary* dictionary, const char* key) {
    const AVDictionaryEntry* entry = libav().av_dict_get(dictionary, key, nullptr, 0);
    return entry == nullptr ? "" : entry->value;
}

}  // namespace

FilmInput::FilmInput(std::string path) : path_(std::move(path)) {
    const LibavMessages messages;
    AVFormatContext* context = nullptr;
    check(libav().avformat_open_input(&context, libav_url(path_).c_str(), nullptr, nullptr),
          messages);
    context_.reset(context);
    check(libav().avformat_find_stream_info(context, nullptr), messages);
    stream_ = libav().av_find_best_stream(context, AVMEDIA_TYPE_VIDEO, -1, -1, &decoder_, 0);
    check(stream_, messages);
    sound_ = libav().av_find_best_stream(context, AVMEDIA_TYPE_AUDIO, -1, -1, nullptr, 0);
}

bool FilmInput::read(AVPacket& packet, bool with_sound) {
    const LibavMessages messages;
    while (true) {
        const int result = libav().av_read_frame(context_.get(), &packet);
        if (result == AVERROR_EOF) return false;
        check(result, messages);
        if (packet.stream_index == stream_ || (with_sound && is_sound(packet))) return true;
        libav().av_packet_unref(&packet);
    }
}

std::string FilmInput::text(const char* key) const { return text_of(context_->metadata, key); }

std::string FilmInput::stream_text(const char* key) const {
    return text_of(stream().metadata, key);
}

void FilmInput::check(int result, const LibavMessages& messages) const {
    if (result < 0) throw_libav(FailureKind::kInput, "read the film", path_, result, messages);
}

}  // namespace carom
