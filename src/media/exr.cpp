#include "media/exr.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/check.h"
#include "core/failure.h"
#include "media/exr_zip.h"
#include "media/openexr_table.h"

namespace carom {

namespace {

constexpr int kTilePx = 32;

void require(exr_result_t result, const char* attempt) {
    if (result != EXR_ERR_SUCCESS)
        throw Failure(FailureKind::kRun,
                      fmt::format("OpenEXR failed while {}: {}", attempt,
                                  openexr().exr_get_default_error_message(result)));
}

extern "C" {
void carom_exr_error(exr_const_context_t, exr_result_t, const char*) {}  // the result says it

/// Into the std::string that is the context's user data.
int64_t carom_exr_write(exr_const_context_t, void* user, const void* bytes, uint64_t size,
                        uint64_t offset, exr_stream_error_func_ptr_t) {
    auto* file = static_cast<std::string*>(user);
    try {
        if (file->size() < offset + size) file->resize(offset + size);
    } catch (...) {
        return -1;  // an exception must not pass through C
    }
    std::memcpy(file->data() + offset, bytes, size);
    return static_cast<int64_t>(size);
}

/// Where the pipeline puts a tile.
struct Packed {
    ExrZip* zip;
    std::string* chunk;
};

/// Keeps a chunk where the pipeline would write it.
exr_result_t carom_exr_keep(exr_encode_pipeline_t* pipeline) {
    const auto* packed = static_cast<Packed*>(pipeline->encoding_user_data);
    try {
        packed->zip->compress(static_cast<const std::uint8_t*>(pipeline->packed_buffer),
                              static_cast<std::size_t>(pipeline->packed_bytes), *packed->chunk);
    } catch (...) {
        return EXR_ERR_OUT_OF_MEMORY;
    }
    return EXR_ERR_SUCCESS;
}
}

/// A file that is being written, into memory.
class ExrFile {
  public:
    ExrFile(const FloatImage& image, const std::vector<std::string>& names) {
        exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
        settings.error_handler_fn = carom_exr_error;
        settings.user_data = &bytes_;
        settings.write_fn = carom_exr_write;
        require(
            openexr().exr_start_write(&context_, "layer.exr", EXR_WRITE_FILE_DIRECTLY, &settings),
            "beginning a file");
        try {
            write_head(image, names);
        } catch (...) {
            openexr().exr_finish(&context_);
            throw;
        }
    }
    ~ExrFile() {
        if (context_ != nullptr) openexr().exr_finish(&context_);
    }
    ExrFile(const ExrFile&) = delete;
    ExrFile& operator=(const ExrFile&) = delete;

    exr_context_t context() const { return context_; }
    std::string finish() {
        require(openexr().exr_finish(&context_), "ending a file");
        context_ = nullptr;
        return std::move(bytes_);
    }

  private:
    void write_head(const FloatImage& image, const std::vector<std::string>& names) {
        int part = 0;
        require(openexr().exr_add_part(context_, "layer", EXR_STORAGE_TILED, &part),
                "adding a part");
        require(openexr().exr_initialize_required_attr_simple(context_, part, image.width_px,
                                                              image.height_px, EXR_COMPRESSION_ZIP),
                "setting the size");
        require(openexr().exr_set_tile_descriptor(context_, part, kTilePx, kTilePx,
                                                  EXR_TILE_ONE_LEVEL, EXR_TILE_ROUND_DOWN),
                "setting the tiles");
        for (const std::string& name : names)
            require(openexr().exr_add_channel(context_, part, name.c_str(), EXR_PIXEL_FLOAT,
                                              EXR_PERCEPTUALLY_LINEAR, 1, 1),
                    "adding a channel");
        require(openexr().exr_write_header(context_), "writing the header");
    }

    exr_context_t context_ = nullptr;
    std::string bytes_;
};

/// Turns tiles into chunks.
class TilePipeline {
  public:
    TilePipeline(const ExrFile& file, const FloatImage& image,
                 const std::vector<std::string>& names, ExrZip& zip)
        : context_(file.context()), image_(image), names_(names), zip_(zip) {}
    ~TilePipeline() {
        if (begun_) openexr().exr_encoding_destroy(context_, &pipeline_);
    }
    TilePipeline(const TilePipeline&) = delete;
    TilePipeline& operator=(const TilePipeline&) = delete;

    void encode(int column, int row, std::string& chunk) {
        exr_chunk_info_t info{};
        require(openexr().exr_write_tile_chunk_info(context_, 0, column, row, 0, 0, &info),
                "placing a tile");
        require(begun_ ? openexr().exr_encoding_update(context_, 0, &info, &pipeline_)
                       : openexr().exr_encoding_initialize(context_, 0, &info, &pipeline_),
                "preparing a tile");
        set_channels(column, row);
        if (!begun_) {
            begun_ = true;
            require(openexr().exr_encoding_choose_default_routines(context_, 0, &pipeline_),
                    "choosing how to encode");
            pipeline_.compress_fn = nullptr;
            pipeline_.write_fn = carom_exr_keep;
        }
        Packed packed{&zip_, &chunk};
        pipeline_.encoding_user_data = &packed;
        require(openexr().exr_encoding_run(context_, 0, &pipeline_), "encoding a tile");
    }

  private:
    void set_channels(int column, int row) {
        constexpr auto kFloat = static_cast<std::int32_t>(sizeof(float));
        const float* corner = image_.at(column * kTilePx, row * kTilePx);
        for (int c = 0; c < pipeline_.channel_count; ++c) {
            exr_coding_channel_info_t& channel = pipeline_.channels[c];
            // The file has them by the alphabet.
            const auto place = std::find(names_.begin(), names_.end(), channel.channel_name);
            channel.user_bytes_per_element = static_cast<std::int16_t>(kFloat);
            channel.user_data_type = EXR_PIXEL_FLOAT;
            channel.user_pixel_stride = kFloat * image_.channels;
            channel.user_line_stride = kFloat * image_.channels * image_.width_px;
            channel.encode_from_ptr =
                reinterpret_cast<const std::uint8_t*>(corner + (place - names_.begin()));
        }
    }

    exr_context_t context_;
    const FloatImage& image_;
    const std::vector<std::string>& names_;
    ExrZip& zip_;
    bool begun_ = false;
    exr_encode_pipeline_t pipeline_{};
};

}  // namespace

void require_openexr() {
    openexr();
    const ExrZip its_own;
}

class ExrEncoder::Impl {
  public:
    explicit Impl(std::vector<std::string> names) : names_(std::move(names)) {}

    std::string encode(const FloatImage& image, const Changed& changed) {
        CAROM_CHECK(image.channels, ==, static_cast<int>(names_.size()));
        const int columns = (image.width_px + kTilePx - 1) / kTilePx;
        const int rows = (image.height_px + kTilePx - 1) / kTilePx;
        chunks_.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
        ExrFile file(image, names_);
        {
            TilePipeline pipeline(file, image, names_, zip_);
            std::size_t i = 0;
            for (int row = 0; row < rows; ++row)
                for (int column = 0; column < columns; ++column, ++i) {
                    const PixelRect tile =
                        PixelRect::at(column * kTilePx, row * kTilePx, kTilePx, kTilePx)
                            .common({0, 0, image.width_px, image.height_px});
                    if (chunks_[i].empty() || changed(tile))
                        pipeline.encode(column, row, chunks_[i]);
                    require(openexr().exr_write_tile_chunk(file.context(), 0, column, row, 0, 0,
                                                           chunks_[i].data(), chunks_[i].size()),
                            "writing a tile");
                }
        }
        return file.finish();
    }

  private:
    std::vector<std::string> names_;
    ExrZip zip_;
    std::vector<std::string> chunks_;  ///< of the picture before, tile by tile
};

ExrEncoder::ExrEncoder(std::vector<std::string> channel_names)
    : impl_(std::make_unique<Impl>(std::move(channel_names))) {}
ExrEncoder::~ExrEncoder() = default;
ExrEncoder::ExrEncoder(ExrEncoder&&) noexcept = default;
std::string ExrEncoder::encode(const FloatImage& image, const Changed& changed) {
    return impl_->encode(image, changed);
}

}  // namespace carom
