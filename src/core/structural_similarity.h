// The structural similarity of two pictures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

/// Mean over all places where the window fits into the picture: a Gaussian of 11 x 11 pixels with
/// sigma 1.5, K1 = 0.01, K2 = 0.03, L = 255 (Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli,
/// Image quality assessment: from error visibility to structural similarity, IEEE Transactions on
/// Image Processing 13(4), 2004, eq. 13-17). A picture with fewer than 11 rows or columns is one
/// window with equal weights.
///
/// Rows come one after the other from the top; 11 of them are kept. Windows that see no difference
/// are 1 and cost nothing: the rest is computed in blocks of columns.
class StructuralSimilarity {
  public:
    /// Brightness, 0 ... 255, of `count` pixels from `pixels` on.
    using Luma = void (*)(const std::byte* pixels, std::size_t count, float* luma);

    StructuralSimilarity(int width_px, int height_px, std::size_t pixel_bytes, Luma luma);

    /// The next row of both pictures.
    void add_row(const std::byte* a, const std::byte* b);
    /// From the next row on; what was added must have the same brightness by either.
    void set_luma(Luma luma) { luma_ = luma; }
    /// After the last row.
    double mean() const;

    static constexpr int kWindow = 11, kHalf = kWindow / 2;

  private:
    /// Sums of s = a + b, d = a - b and their squares, weighted along x, a window's place each.
    using Moments = std::array<std::vector<float>, 4>;
    struct Row {
        std::vector<std::byte> a, b;
        Moments moments;
        std::vector<std::uint8_t> known;  ///< blocks whose moments are there
    };
    void add_to_one_window(const std::byte* a, const std::byte* b);
    bool sees_difference(std::size_t block) const;
    void make_moments(Row& row, std::size_t block);
    double sum_of_windows(std::size_t block);
    std::size_t windows_of(std::size_t block) const;

    int width_, height_;
    std::size_t pixel_bytes_;
    Luma luma_;
    bool one_window_;
    std::array<float, kHalf + 1> weights_;
    int rows_ = 0;  ///< so far
    std::array<Row, kWindow> ring_;
    std::vector<int> last_difference_;  ///< of a block of pixels: its row, or one long ago
    double sum_ = 0;                    ///< of all windows so far
    std::array<double, 4> window_{};    ///< sums of the one window
};

}  // namespace carom
