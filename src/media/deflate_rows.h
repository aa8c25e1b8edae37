// Deflate for filtered rows of drawn pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace carom {

/// Compresses rows into one block of deflate with Huffman tables of its own (RFC 1951, 3.2.7),
/// followed by an empty stored block that ends on a whole byte, as zlib's full flush does: such
/// pieces can stand one behind the other, and do not refer to one another.
///
/// Drawn pictures have plain areas, which are runs of one byte after a filter: so matches are
/// sought at the distance 1 alone, as zlib's Z_RLE does in 2.6 times the time. Matches a row away
/// make such pictures larger, for their distances and the tables cost more than they save.
///
/// Holds buffers between calls; use one object per thread.
class RowDeflater {
  public:
    struct Piece {
        std::string bytes;
        std::uint32_t adler = 1;  ///< Adler-32 of what was compressed
    };
    Piece compress(const std::vector<std::uint8_t>& bytes, std::size_t size);

  private:
    std::uint32_t find_tokens(const std::uint8_t* bytes, std::size_t size);

    /// A byte, or the length of a run of the one before it, with the highest bit set.
    std::vector<std::uint32_t> tokens_;
    std::size_t token_count_ = 0;  ///< of them in use
    std::vector<char> room_;       ///< for the compressed bytes
};

}  // namespace carom
