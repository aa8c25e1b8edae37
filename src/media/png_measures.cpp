#include "media/png_measures.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <future>
#include <system_error>
#include <vector>

#include "core/image.h"
#include "media/png_row_reader.h"

namespace carom {

namespace {

/// Of a band's samples in memory: enough rows that a thread pays, few enough for the cache.
constexpr std::size_t kBandBytes = 1 << 19;

int rows_of_band(const PngRowReader& reader, std::size_t sample_bytes) {
    const std::size_t row = static_cast<std::size_t>(reader.width_px()) * kChannels * sample_bytes;
    return static_cast<int>(std::max<std::size_t>(1, kBandBytes / row));
}

bool have_one_content(const std::string& a, const std::string& b) {
    std::ifstream one(a, std::ios::binary | std::ios::ate);
    std::ifstream other(b, std::ios::binary | std::ios::ate);
    if (!one || !other || one.tellg() < 0 || one.tellg() != other.tellg()) return false;
    one.seekg(0);
    other.seekg(0);
    std::vector<char> part_a(1 << 16), part_b(part_a.size());
    while (one && other) {
        one.read(part_a.data(), static_cast<std::streamsize>(part_a.size()));
        other.read(part_b.data(), static_cast<std::streamsize>(part_b.size()));
        if (one.gcount() != other.gcount() ||
            std::memcmp(part_a.data(), part_b.data(), static_cast<std::size_t>(one.gcount())) != 0)
            return false;
    }
    return one.eof() && other.eof();
}

template <class Work>
std::future<void> beside(const Work& work) {
    try {
        return std::async(std::launch::async, work);
    } catch (const std::system_error&) {  // no more threads
        return std::async(std::launch::deferred, work);
    }
}

/// Reads on to the end, for what is wrong with the file.
template <class Sample>
void read_all(PngRowReader& reader) {
    const int band = rows_of_band(reader, sizeof(Sample));
    std::vector<Sample> rows(static_cast<std::size_t>(reader.width_px()) * kChannels *
                             static_cast<std::size_t>(band));
    for (int y = 0; y < reader.height_px(); y += band)
        reader.read(rows.data(), std::min(band, reader.height_px() - y));
}

void read_all(PngRowReader& reader) {
    if (reader.is_deep())
        read_all<std::uint16_t>(reader);
    else
        read_all<std::uint8_t>(reader);
}

template <class Sample>
ImageMeasures measure(PngRowReader& a, PngRowReader& b) {
    const int height = a.height_px(), band = rows_of_band(a, sizeof(Sample));
    const std::size_t row = static_cast<std::size_t>(a.width_px()) * kChannels;
    std::vector<Sample> of_a(row * static_cast<std::size_t>(band)), of_b(of_a), next_b(of_a);
    const auto rows_at = [&](int y) { return std::min(band, height - y); };
    const auto read_b = [&](int y) {
        return beside([&b, &next_b, rows = rows_at(y)] { b.read(next_b.data(), rows); });
    };
    MeasuredRows<Sample> measured(a.width_px(), height);
    std::future<void> other = read_b(0);
    for (int y = 0; y < height; y += band) {
        a.read(of_a.data(), rows_at(y));
        other.get();
        of_b.swap(next_b);
        if (y + band < height) other = read_b(y + band);
        for (std::size_t i = 0; i < static_cast<std::size_t>(rows_at(y)); ++i)
            measured.add_row(of_a.data() + i * row, of_b.data() + i * row);
    }
    return measured.measures();
}

}  // namespace

ImageMeasures measure_pngs(const std::string& path_a, const std::string& path_b) {
    PngRowReader a(path_a);
    ImageMeasures result;
    if (have_one_content(path_a, path_b)) {
        read_all(a);
        MeasuredRows<std::uint8_t> none(a.width_px(), a.height_px());
        return none.measures();
    }
    PngRowReader b(path_b);
    if (a.width_px() != b.width_px() || a.height_px() != b.height_px()) {
        std::future<void> other = beside([&b] { read_all(b); });
        read_all(a);
        other.get();
        result.same_size = false;
        return result;
    }
    return a.is_deep() || b.is_deep() ? measure<std::uint16_t>(a, b) : measure<std::uint8_t>(a, b);
}

}  // namespace carom
