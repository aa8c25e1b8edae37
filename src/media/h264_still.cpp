#include "media/h264_still.h"

#include <algorithm>
#include <bit>
#include <vector>

namespace carom {

namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr int kSlice = 1, kIdrSlice = 5, kSupplement = 6, kSequence = 7, kPicture = 8;
constexpr unsigned kOwnPicture = 1;  ///< number of our picture parameter set; x264's is 0

/// The NAL units of a byte stream, without their start codes.
std::vector<Bytes> units_of(Bytes stream) {
    std::vector<Bytes> units;
    std::size_t begin = stream.size();
    for (std::size_t i = 0; i + 2 < stream.size(); ++i) {
        if (stream[i] != 0 || stream[i + 1] != 0 || stream[i + 2] != 1) continue;
        if (begin < i) units.push_back(stream.subspan(begin, i - begin));
        begin = i + 3;
        i += 2;
    }
    if (begin < stream.size()) units.push_back(stream.subspan(begin));
    // A start code of four bytes leaves its first at the end of the unit before.
    for (Bytes& unit : units)
        while (!unit.empty() && unit.back() == 0) unit = unit.first(unit.size() - 1);
    std::erase_if(units, [](Bytes unit) { return unit.empty(); });
    return units;
}

int type_of(Bytes unit) { return unit[0] & 31; }
bool is_reference(Bytes unit) { return (unit[0] & 0x60) != 0; }

/// Reads the bits behind a unit's first byte, 9.1; beyond the end there are zeros.
class BitReader {
  public:
    explicit BitReader(Bytes unit) {
        constexpr std::size_t kMost = 64;  // what is read stands at the beginning
        int zeros = 0;
        for (std::size_t i = 1; i < unit.size() && bytes_.size() < kMost; ++i) {
            const bool prevention = zeros >= 2 && unit[i] == 3;
            if (!prevention) bytes_.push_back(unit[i]);
            zeros = unit[i] == 0 ? zeros + 1 : 0;
        }
    }
    unsigned bits(int count) {
        unsigned value = 0;
        for (; count > 0; --count, ++at_) {
            const std::size_t byte = at_ / 8;
            const unsigned bit = byte < bytes_.size() ? bytes_[byte] >> (7 - at_ % 8) & 1U : 0U;
            value = value << 1 | bit;
        }
        return value;
    }
    unsigned number() {
        int zeros = 0;
        while (zeros < 31 && bits(1) == 0) ++zeros;
        return (1U << zeros) - 1 + bits(zeros);
    }

  private:
    std::vector<std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

class BitWriter {
  public:
    BitWriter& bits(unsigned value, int count) {
        for (int i = count - 1; i >= 0; --i) put(value >> i & 1U);
        return *this;
    }
    BitWriter& number(unsigned value) {
        const int length = std::bit_width(value + 1);
        return bits(0, length - 1).bits(value + 1, length);
    }
    /// A NAL unit behind its start code, with the bits' end and what keeps start codes out of it.
    std::string unit(int reference, int type) {
        put(1);
        while (used_ != 0) put(0);
        std::string all("\0\0\0\1", 4);
        all += static_cast<char>(reference << 5 | type);
        int zeros = 0;
        for (const std::uint8_t byte : bytes_) {
            if (zeros >= 2 && byte <= 3) {
                all += '\3';
                zeros = 0;
            }
            all += static_cast<char>(byte);
            zeros = byte == 0 ? zeros + 1 : 0;
        }
        return all;
    }

  private:
    void put(unsigned bit) {
        if (used_ == 0) bytes_.push_back(0);
        bytes_.back() = static_cast<std::uint8_t>(bytes_.back() | bit << (7 - used_));
        used_ = (used_ + 1) % 8;
    }
    std::vector<std::uint8_t> bytes_;
    int used_ = 0;  ///< bits of the last byte
};

/// 7.3.2.2: as simple as can be, without arithmetic coding, weights and deblocking.
std::string own_parameter_set(unsigned sequence) {
    BitWriter set;
    set.number(kOwnPicture).number(sequence);
    set.bits(0, 1).bits(0, 1).number(0);            // entropy coding, order of fields, slice groups
    set.number(0).number(0).bits(0, 1).bits(0, 2);  // one reference each, no weights
    set.number(0).number(0).number(0);              // quantisers
    set.bits(1, 1).bits(0, 1).bits(0, 1);           // slices say whether they are deblocked
    return set.unit(3, kPicture);
}

}  // namespace

std::optional<H264Still> H264Still::read(Bytes headers) {
    for (const Bytes unit : units_of(headers)) {
        if (type_of(unit) != kSequence) continue;
        // 7.3.2.1.1
        H264Still still;
        BitReader set(unit);
        const unsigned profile = set.bits(8);
        set.bits(16);
        still.sequence_ = set.number();
        constexpr unsigned kHigh = 100, kHigh10 = 110, kHigh422 = 122, kHigh444 = 244;
        if (profile == kHigh || profile == kHigh10 || profile == kHigh422 || profile == kHigh444) {
            if (set.number() == 3) set.bits(1);  // 4:4:4, as three pictures or not
            set.number(), set.number();          // depths
            set.bits(1);
            if (set.bits(1) != 0) return std::nullopt;  // scaling lists
        }
        still.frame_num_bits_ = static_cast<int>(set.number()) + 4;
        const unsigned order = set.number();
        if (order == 0) still.order_bits_ = static_cast<int>(set.number()) + 4;
        if (order == 1) return std::nullopt;
        set.number(), set.bits(1);
        const unsigned across = set.number() + 1, down = set.number() + 1;
        if (set.bits(1) == 0) return std::nullopt;  // fields
        still.macroblocks_ = across * down;
        still.parameter_set_ = own_parameter_set(still.sequence_);
        return still;
    }
    return std::nullopt;
}

bool H264Still::follow(Bytes stream, std::int64_t frame) {
    for (const Bytes unit : units_of(stream)) {
        const bool idr = type_of(unit) == kIdrSlice;
        if (!idr && type_of(unit) != kSlice) continue;
        BitReader slice(unit);
        slice.number(), slice.number(), slice.number();
        const unsigned number = slice.bits(frame_num_bits_);
        if (idr) {
            slice.number();
            idr_frame_ = frame;
        }
        const std::uint32_t most = 1U << frame_num_bits_;
        next_frame_num_ = is_reference(unit) ? (number + 1) % most : number;
        if (order_bits_ == 0) return true;
        const auto order = static_cast<std::uint32_t>(2 * (frame - idr_frame_));
        return slice.bits(order_bits_) == order % (1U << order_bits_);
    }
    return false;
}

std::string H264Still::repeat(std::int64_t frame) {
    constexpr unsigned kOnlyP = 5, kNoDeblocking = 1;
    BitWriter slice;
    slice.number(0).number(kOnlyP).number(kOwnPicture).bits(next_frame_num_, frame_num_bits_);
    if (order_bits_ > 0) {
        const auto order = static_cast<std::uint32_t>(2 * (frame - idr_frame_));
        slice.bits(order % (1U << order_bits_), order_bits_);
    }
    slice.bits(0, 1).bits(0, 1);  // as many references, in their order
    slice.bits(0, 1);             // the oldest reference goes
    slice.number(0).number(kNoDeblocking);
    slice.number(macroblocks_);  // mb_skip_run
    next_frame_num_ = (next_frame_num_ + 1) % (1U << frame_num_bits_);
    return slice.unit(2, kSlice);
}

std::string H264Still::pictures_of(Bytes stream) {
    std::string all;
    for (const Bytes unit : units_of(stream)) {
        if (type_of(unit) == kSupplement) continue;
        all.append("\0\0\0\1", 4);
        all.append(unit.begin(), unit.end());
    }
    return all;
}

}  // namespace carom
