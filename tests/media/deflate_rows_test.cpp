// Our deflate against zlib's inflate.
#include "media/deflate_rows.h"

#include <zlib.h>

#include <numeric>

#include "media_fixture.h"

namespace carom {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// What zlib makes of pieces one behind the other and a last, empty block.
Bytes inflated(const std::string& pieces, std::size_t size) {
    const std::string all = pieces + std::string("\x03\0", 2);
    Bytes out(size + 1);
    z_stream stream = {};
    EXPECT_EQ(inflateInit2(&stream, -15), Z_OK);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(all.data()));
    stream.avail_in = static_cast<uInt>(all.size());
    stream.next_out = out.data();
    stream.avail_out = static_cast<uInt>(out.size());
    EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END) << (stream.msg ? stream.msg : "");
    EXPECT_EQ(stream.avail_in, 0U);
    out.resize(stream.total_out);
    inflateEnd(&stream);
    return out;
}

std::string compressed(const Bytes& bytes) {
    const RowDeflater::Piece piece = RowDeflater().compress(bytes, bytes.size());
    EXPECT_EQ(piece.adler, adler32(1, bytes.data(), static_cast<uInt>(bytes.size())));
    return piece.bytes;
}

TEST(RowDeflater, GivesEverythingBack) {
    std::mt19937 random(1);
    std::vector<Bytes> cases = {{}, {7}, {7, 7}, {7, 7, 7}, {7, 7, 7, 7}, Bytes(100'000, 0)};
    Bytes all(256);
    std::iota(all.begin(), all.end(), std::uint8_t{0});
    cases.push_back(all);
    for (const std::size_t length : {257U, 258U, 259U, 260U, 261U, 516U, 517U, 1000U}) {
        Bytes runs(length, 1);
        runs.insert(runs.end(), length + 1, 2);
        cases.push_back(runs);
    }
    Bytes noise(50'000);
    for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
    cases.push_back(noise);
    for (const Bytes& bytes : cases) EXPECT_EQ(inflated(compressed(bytes), bytes.size()), bytes);
}

// Each byte twice as often as the one before: Huffman's codes would have up to 26 bits, deflate has
// at most 15.
TEST(RowDeflater, CodesAreNotTooLong) {
    Bytes bytes;
    for (int i = 0; i < 21; ++i)
        for (int n = 0; n < 1 << i; ++n) bytes.push_back(static_cast<std::uint8_t>(10 * i));
    std::mt19937 random(2);
    std::shuffle(bytes.begin(), bytes.end(), random);
    const std::string pieces = compressed(bytes);
    EXPECT_EQ(inflated(pieces, bytes.size()), bytes);
    // The entropy is just below 2 bits a byte; runs of three by chance are coded as such and cost
    // some more.
    std::printf("%.3f bits a byte (entropy 2, bound 2.25)\n",
                8.0 * static_cast<double>(pieces.size()) / static_cast<double>(bytes.size()));
    EXPECT_LT(8.0 * static_cast<double>(pieces.size()), 2.25 * static_cast<double>(bytes.size()));
}

TEST(RowDeflater, NoiseHardlyGrows) {
    std::mt19937 random(3);
    Bytes noise(100'000);
    for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
    EXPECT_LT(static_cast<double>(compressed(noise).size()), 1.005 * 100'000);
}

TEST(RowDeflater, PiecesStandOneBehindTheOther) {
    RowDeflater deflater;
    Bytes all;
    std::string pieces;
    for (int i = 0; i < 20; ++i) {
        Bytes part(static_cast<std::size_t>(100 * i), static_cast<std::uint8_t>(i));
        for (std::size_t k = 0; k < part.size(); k += 7) part[k] = static_cast<std::uint8_t>(k);
        pieces += deflater.compress(part, part.size()).bytes;
        all.insert(all.end(), part.begin(), part.end());
    }
    EXPECT_EQ(inflated(pieces, all.size()), all);
}

}  // namespace
}  // namespace carom
