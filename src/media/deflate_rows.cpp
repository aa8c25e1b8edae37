#include "media/deflate_rows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <queue>
#include <span>
#include <utility>

#include "core/check.h"

namespace carom {

namespace {

constexpr std::uint32_t kRun = 0x80000000U;
constexpr std::size_t kLeastRun = 3, kMostRun = 258;
constexpr int kEndOfBlock = 256;
constexpr std::size_t kLiterals = 286, kDistances = 1, kLengthCodes = 19;

/// A symbol, and what stands in plain bits behind it (RFC 1951, 3.2.5).
struct Symbol {
    int code = 0, extra_bits = 0;
    std::uint32_t extra = 0;
};

/// Lengths 3 ... 258: four codes for each power of two from 8 on.
Symbol length_symbol(std::size_t length) {
    if (length == kMostRun) return {285, 0, 0};
    const auto n = static_cast<std::uint32_t>(length - 3);
    if (n < 8) return {257 + static_cast<int>(n), 0, 0};
    const int bits = std::bit_width(n) - 3;
    return {257 + 4 * bits + 4 + static_cast<int>((n >> bits) & 3), bits, n & ((1U << bits) - 1)};
}

/// Bits into bytes, the lowest first.
class BitWriter {
  public:
    explicit BitWriter(std::string& bytes) : bytes_(bytes) {}
    void put(std::uint32_t value, int bits) {
        buffer_ |= static_cast<std::uint64_t>(value) << count_;
        count_ += bits;
        while (count_ >= 32) {
            const auto word = static_cast<std::uint32_t>(buffer_);
            bytes_.append(reinterpret_cast<const char*>(&word), sizeof word);
            buffer_ >>= 32;
            count_ -= 32;
        }
    }
    void pad() {
        for (; count_ > 0; count_ -= 8, buffer_ >>= 8) bytes_ += static_cast<char>(buffer_ & 255);
        count_ = 0;
        buffer_ = 0;
    }

  private:
    std::string& bytes_;
    std::uint64_t buffer_ = 0;
    int count_ = 0;
};

static_assert(std::endian::native == std::endian::little, "words are written as they lie");

/// The lengths of Huffman's codes; those of unused symbols are 0.
std::vector<int> huffman_lengths(const std::vector<std::uint32_t>& counts) {
    struct Node {
        std::uint64_t count;
        int left, right;
    };
    std::vector<Node> nodes;
    using Entry = std::pair<std::uint64_t, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    for (const std::uint32_t count : counts) {
        if (count > 0) open.emplace(count, static_cast<int>(nodes.size()));
        nodes.push_back({count, -1, -1});
    }
    std::vector<int> lengths(counts.size());
    if (open.size() == 1) lengths[static_cast<std::size_t>(open.top().second)] = 1;
    while (open.size() > 1) {
        const auto [a_count, a] = open.top();
        open.pop();
        const auto [b_count, b] = open.top();
        open.pop();
        open.emplace(a_count + b_count, static_cast<int>(nodes.size()));
        nodes.push_back({a_count + b_count, a, b});
    }
    // Parents stand behind their children: from the root down.
    std::vector<int> depth(nodes.size());
    for (std::size_t i = nodes.size(); i-- > counts.size();)
        for (const int child : {nodes[i].left, nodes[i].right})
            depth[static_cast<std::size_t>(child)] = depth[i] + 1;
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (lengths[i] == 0) lengths[i] = depth[i];
    return lengths;
}

/// Codes of at most `longest` bits: where Huffman's are longer, counts are halved until they are
/// alike enough.
struct Code {
    std::vector<int> lengths;
    std::vector<std::uint32_t> codes;  ///< the first bit lowest

    Code(std::span<const std::uint32_t> given, int longest) {
        std::vector<std::uint32_t> counts(given.begin(), given.end());
        while (lengths = huffman_lengths(counts),
               *std::max_element(lengths.begin(), lengths.end()) > longest)
            for (std::uint32_t& count : counts) count = count > 0 ? (count + 1) / 2 : 0;
        assign();
    }

  private:
    /// RFC 1951, 3.2.2: by length, then by symbol.
    void assign() {
        constexpr int kMostBits = 15;
        std::array<std::uint32_t, kMostBits + 2> next{};
        for (const int length : lengths)
            if (length > 0) ++next[static_cast<std::size_t>(length) + 1];
        for (std::size_t bits = 1; bits < next.size(); ++bits)
            next[bits] = (next[bits] + next[bits - 1]) << 1;
        codes.resize(lengths.size());
        for (std::size_t i = 0; i < lengths.size(); ++i) {
            if (lengths[i] == 0) continue;
            std::uint32_t code = next[static_cast<std::size_t>(lengths[i])]++, turned = 0;
            for (int b = 0; b < lengths[i]; ++b, code >>= 1) turned = turned << 1 | (code & 1);
            codes[i] = turned;
        }
    }
};

/// The lengths of both codes as RFC 1951, 3.2.7 has them: a length, or a repetition (16: of the
/// last, 17 and 18: of zeros) with its extra bits.
std::vector<Symbol> run_lengths(const std::vector<int>& lengths) {
    std::vector<Symbol> symbols;
    for (std::size_t i = 0; i < lengths.size();) {
        std::size_t run = 1;
        while (i + run < lengths.size() && lengths[i + run] == lengths[i]) ++run;
        const int length = lengths[i];
        i += run;
        if (length != 0) symbols.push_back({length, 0, 0}), --run;
        while (run >= 3) {
            const std::size_t most = length != 0 ? 6 : run > 10 ? 138 : 10;
            const std::size_t part = std::min(run, most);
            if (length != 0)
                symbols.push_back({16, 2, static_cast<std::uint32_t>(part - 3)});
            else if (most == 10)
                symbols.push_back({17, 3, static_cast<std::uint32_t>(part - 3)});
            else
                symbols.push_back({18, 7, static_cast<std::uint32_t>(part - 11)});
            run -= part;
        }
        for (; run > 0; --run) symbols.push_back({length, 0, 0});
    }
    return symbols;
}

void put_tables(BitWriter& out, const Code& literals, const Code& distances) {
    constexpr std::array<std::size_t, kLengthCodes> kOrder = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                              11, 4,  12, 3, 13, 2, 14, 1, 15};
    std::vector<int> lengths = literals.lengths;
    lengths.insert(lengths.end(), distances.lengths.begin(), distances.lengths.end());
    const std::vector<Symbol> symbols = run_lengths(lengths);
    std::array<std::uint32_t, kLengthCodes> counts{};
    for (const Symbol& s : symbols) ++counts[static_cast<std::size_t>(s.code)];
    constexpr int kMostBits = 7;
    const Code code(counts, kMostBits);
    std::size_t used = kLengthCodes;
    while (used > 4 && code.lengths[kOrder[used - 1]] == 0) --used;
    out.put(static_cast<std::uint32_t>(kLiterals - 257), 5);
    out.put(static_cast<std::uint32_t>(kDistances - 1), 5);
    out.put(static_cast<std::uint32_t>(used - 4), 4);
    for (std::size_t i = 0; i < used; ++i)
        out.put(static_cast<std::uint32_t>(code.lengths[kOrder[i]]), 3);
    for (const Symbol& s : symbols) {
        const auto i = static_cast<std::size_t>(s.code);
        out.put(code.codes[i], code.lengths[i]);
        out.put(s.extra, s.extra_bits);
    }
}

/// How many bytes from `p` on equal those from `q` on, up to `most`.
std::size_t equal_bytes(const std::uint8_t* p, const std::uint8_t* q, std::size_t most) {
    std::size_t n = 0;
    for (; n + 8 <= most; n += 8) {
        std::uint64_t a = 0, b = 0;
        std::memcpy(&a, p + n, sizeof a);
        std::memcpy(&b, q + n, sizeof b);
        if (a != b) return n + static_cast<std::size_t>(std::countr_zero(a ^ b)) / 8;
    }
    while (n < most && p[n] == q[n]) ++n;
    return n;
}

}  // namespace

void RowDeflater::find_tokens(const std::uint8_t* bytes, std::size_t size) {
    tokens_.clear();
    if (size > 0) tokens_.push_back(bytes[0]);
    for (std::size_t i = 1; i < size;) {
        std::size_t length = 0;
        if (bytes[i] == bytes[i - 1])
            length = equal_bytes(bytes + i, bytes + i - 1, std::min(kMostRun, size - i));
        if (length < kLeastRun) {
            tokens_.push_back(bytes[i++]);
        } else {
            tokens_.push_back(kRun | static_cast<std::uint32_t>(length));
            i += length;
        }
    }
}

std::string RowDeflater::compress(const std::vector<std::uint8_t>& bytes, std::size_t size) {
    CAROM_CHECK(size, <=, bytes.size());
    find_tokens(bytes.data(), size);
    std::array<Symbol, kMostRun + 1> lengths{};
    for (std::size_t n = kLeastRun; n <= kMostRun; ++n) lengths[n] = length_symbol(n);

    std::array<std::uint32_t, kLiterals> counts{};
    std::array<std::uint32_t, kDistances> runs{};
    ++counts[kEndOfBlock];
    for (const std::uint32_t token : tokens_) {
        const bool run = (token & kRun) != 0;
        ++counts[run ? static_cast<std::size_t>(lengths[token & ~kRun].code) : token];
        if (run) ++runs[0];
    }
    constexpr int kMostBits = 15;
    const Code literals(counts, kMostBits), distances(runs, kMostBits);

    std::string result;
    result.reserve(tokens_.size() + 1024);
    BitWriter out(result);
    out.put(2 << 1, 3);  // not the last block; tables of its own
    put_tables(out, literals, distances);
    for (const std::uint32_t token : tokens_) {
        if ((token & kRun) == 0) {
            out.put(literals.codes[token], literals.lengths[token]);
            continue;
        }
        const Symbol& length = lengths[token & ~kRun];
        const auto i = static_cast<std::size_t>(length.code);
        out.put(literals.codes[i], literals.lengths[i]);
        out.put(length.extra, length.extra_bits);
        out.put(0, 1);  // distance 1, the only one: a single bit
    }
    out.put(literals.codes[kEndOfBlock], literals.lengths[kEndOfBlock]);
    out.put(0, 3);  // a stored block of no bytes: its length begins on a whole byte
    out.pad();
    result += std::string("\0\0\xFF\xFF", 4);
    return result;
}

}  // namespace carom
