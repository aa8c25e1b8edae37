// PNG files row by row.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace carom {

/// The rows of any PNG as read_any_png() has them (png.h), from the top, without keeping them; only
/// of interlaced files all are kept. Fails as it does: at the head, or where the damage is.
class PngRowReader {
  public:
    /// Reads what stands before the pixels.
    explicit PngRowReader(const std::string& path);
    ~PngRowReader();
    PngRowReader(const PngRowReader&) = delete;
    PngRowReader& operator=(const PngRowReader&) = delete;

    int width_px() const { return width_px_; }
    int height_px() const { return height_px_; }
    /// 16 bits a sample; else 8.
    bool is_deep() const { return deep_; }

    /// The next `rows` rows, B, G, R, A premultiplied; after the last one also what stands behind
    /// the pixels is read. The first is for pictures of 8 bits alone, the second for any.
    void read(std::uint8_t* bgra, int rows);
    void read(std::uint16_t* bgra, int rows);

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
    int width_px_ = 0, height_px_ = 0;
    bool deep_ = false;
};

}  // namespace carom
