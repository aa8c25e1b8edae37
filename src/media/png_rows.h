// The compressed rows of a PNG, made anew only where they have changed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/image.h"
#include "media/deflate_rows.h"

namespace carom {

/// Filters and compresses pictures of a film for PNG's IDAT chunks.
///
/// The rows are cut into bands. Each is filtered (row by row Sub, a pixel less the one to its left,
/// or Up, less the one above, whichever makes more zeros) and deflated by itself (deflate_rows.h),
/// so that its bytes follow from its pixels alone: of a band that equals that of the picture
/// before, they are used again. The bytes of a picture are the same whatever came before it. A band
/// costs some 80 bytes for its own Huffman tables.
///
/// Memory: one picture, and its compressed bytes.
class PngRows {
  public:
    /// A zlib stream (RFC 1950) of the filtered rows, in pieces that belong one behind the other;
    /// they live until the next call. `opaque()` says which colour type they have.
    const std::vector<const std::string*>& compress(const Image& image);

    /// The last picture was kept as RGB; else as RGBA with straight alpha.
    bool opaque() const { return opaque_; }

  private:
    struct Band {
        RowDeflater::Piece piece;  ///< empty: not made yet
        std::size_t filtered = 0;  ///< how many these are
        bool opaque = true;
    };
    void make(Band& band, int first_row, int rows);

    Image picture_;
    bool opaque_ = true;
    std::vector<Band> bands_;
    RowDeflater deflater_;
    std::string head_, tail_;
    std::vector<const std::string*> pieces_;
    std::vector<std::uint8_t> filtered_, row_;
};

}  // namespace carom
