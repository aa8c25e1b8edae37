#include "core/checksum.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <new>

namespace carom {

struct Checksum::State {
    XXH3_state_t* xxh3 = XXH3_createState();
    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() { XXH3_freeState(xxh3); }
};

Checksum::Checksum() : state_(std::make_unique<State>()) {
    if (state_->xxh3 == nullptr) throw std::bad_alloc();
    XXH3_64bits_reset(state_->xxh3);
}

Checksum::~Checksum() = default;

void Checksum::add(const void* bytes, std::size_t size) {
    XXH3_64bits_update(state_->xxh3, bytes, size);
}

std::uint64_t Checksum::value() const { return XXH3_64bits_digest(state_->xxh3); }

std::string checksum_text(std::string_view bytes) {
    const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace carom
