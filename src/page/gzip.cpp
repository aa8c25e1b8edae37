#include "page/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <limits>

#include "core/check.h"

namespace carom {

std::string gzip(std::string_view text) {
    constexpr int kGzip = 16, kWindow = 15, kMemory = 9;
    z_stream stream{};
    CAROM_CHECK(deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kWindow + kGzip, kMemory,
                             Z_DEFAULT_STRATEGY),
                ==, Z_OK);
    std::string packed;
    std::string block(1U << 16U, '\0');
    int state = Z_OK;
    while (state != Z_STREAM_END) {
        if (stream.avail_in == 0) {  // it counts in 32 bits
            const std::size_t part =
                std::min<std::size_t>(text.size(), std::numeric_limits<uInt>::max());
            stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
            stream.avail_in = static_cast<uInt>(part);
            text.remove_prefix(part);
        }
        stream.next_out = reinterpret_cast<Bytef*>(block.data());
        stream.avail_out = static_cast<uInt>(block.size());
        state = deflate(&stream, text.empty() ? Z_FINISH : Z_NO_FLUSH);
        CAROM_CHECK(state, >=, Z_OK);
        packed.append(block, 0, block.size() - stream.avail_out);
    }
    deflateEnd(&stream);
    return packed;
}

}  // namespace carom
