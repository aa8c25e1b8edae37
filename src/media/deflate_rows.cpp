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

/// Bits into bytes, the lowest first; there must be room for all of them and 8 bytes more.
class BitWriter {
  public:
    explicit BitWriter(char* bytes) : bytes_(bytes) {}
    /// At most 32 bits.
    void put(std::uint32_t value, int bits) {
        buffer_ |= static_cast<std::uint64_t>(value) << count_;
        count_ += bits;
        std::memcpy(bytes_, &buffer_, sizeof buffer_);  // whole bytes of it count from now on
        const int whole = count_ / 8;
        bytes_ += whole;
        buffer_ >>= 8 * whole;
        count_ -= 8 * whole;
    }
    /// Fills the last byte with zeros; where the bytes end.
    char* end() {
        if (count_ > 0) put(0, 8 - count_);
        return bytes_;
    }

  private:
    char* bytes_;
    std::uint64_t buffer_ = 0;
    int count_ = 0;  ///< bits in it, less than 8 between two calls
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

/// Adler-32 (RFC 1950, 8.2) of bytes that come in runs: n bytes v add n v to the first sum, and to
/// the second n times the first one and v n (n + 1) / 2.
class Adler {
  public:
    void add(std::uint64_t v, std::uint64_t n) {
        second_ += n * first_ + v * (n * (n + 1) / 2);
        first_ += n * v;
        constexpr int kMostAdded = 1024;  // of at most 258 * 255: far from 2^64
        if (++added_ == kMostAdded) reduce();
    }
    std::uint32_t value() {
        reduce();
        return static_cast<std::uint32_t>(second_ << 16 | first_);
    }

  private:
    void reduce() {
        constexpr std::uint64_t kBase = 65521;
        first_ %= kBase;
        second_ %= kBase;
        added_ = 0;
    }
    std::uint64_t first_ = 1, second_ = 0;
    int added_ = 0;
};

}  // namespace

std::uint32_t RowDeflater::find_tokens(const std::uint8_t* bytes, std::size_t size) {
    Adler adler;
    if (tokens_.size() < size) tokens_.resize(size);
    std::uint32_t* token = tokens_.data();
    const auto literal = [&](std::uint8_t byte) {
        *token++ = byte;
        adler.add(byte, 1);
    };
    if (size > 0) literal(bytes[0]);
    for (std::size_t i = 1; i < size;) {
        std::size_t length = 0;
        if (bytes[i] == bytes[i - 1])
            length = equal_bytes(bytes + i, bytes + i - 1, std::min(kMostRun, size - i));
        if (length < kLeastRun) {
            literal(bytes[i++]);
        } else {
            *token++ = kRun | static_cast<std::uint32_t>(length);
            adler.add(bytes[i], length);
            i += length;
        }
    }
    token_count_ = static_cast<std::size_t>(token - tokens_.data());
    return adler.value();
}

RowDeflater::Piece RowDeflater::compress(const std::vector<std::uint8_t>& bytes, std::size_t size) {
    CAROM_CHECK(size, <=, bytes.size());
    Piece piece;
    piece.adler = find_tokens(bytes.data(), size);
    const std::span tokens(tokens_.data(), token_count_);
    std::array<Symbol, kMostRun + 1> lengths{};
    for (std::size_t n = kLeastRun; n <= kMostRun; ++n) lengths[n] = length_symbol(n);

    std::array<std::uint32_t, kLiterals> counts{};
    std::array<std::uint32_t, kDistances> runs{};
    ++counts[kEndOfBlock];
    for (const std::uint32_t token : tokens) {
        const bool run = (token & kRun) != 0;
        ++counts[run ? static_cast<std::size_t>(lengths[token & ~kRun].code) : token];
        if (run) ++runs[0];
    }
    constexpr int kMostBits = 15;
    const Code literals(counts, kMostBits), distances(runs, kMostBits);

    // A run: its length's code, the length's own bits, and a bit for the distance, which is the
    // only one; 21 bits at most.
    struct Bits {
        std::uint32_t value;
        int count;
    };
    std::array<Bits, kMostRun + 1> run_bits{};
    for (std::size_t n = kLeastRun; n <= kMostRun; ++n) {
        const auto i = static_cast<std::size_t>(lengths[n].code);
        run_bits[n] = {literals.codes[i] | lengths[n].extra << literals.lengths[i],
                       literals.lengths[i] + lengths[n].extra_bits + 1};
    }

    constexpr std::size_t kMostTableBytes = 1024, kMostTokenBytes = 3;
    const std::size_t room = kMostTableBytes + kMostTokenBytes * tokens.size();
    if (room_.size() < room) room_.resize(room);
    BitWriter out(room_.data());
    out.put(2 << 1, 3);  // not the last block; tables of its own
    put_tables(out, literals, distances);
    for (const std::uint32_t token : tokens) {
        if ((token & kRun) == 0) {
            out.put(literals.codes[token], literals.lengths[token]);
        } else {
            const Bits& bits = run_bits[token & ~kRun];
            out.put(bits.value, bits.count);
        }
    }
    out.put(literals.codes[kEndOfBlock], literals.lengths[kEndOfBlock]);
    out.put(0, 3);  // a stored block of no bytes: its length begins on a whole byte
    piece.bytes.assign(room_.data(), out.end());
    piece.bytes += std::string("\0\0\xFF\xFF", 4);
    return piece;
}

}  // namespace carom
