// Numbers that tell contents apart (XXH3: not against somebody who wants them equal).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace carom {

/// 64 bits of what is added piece by piece; how it is cut into pieces changes nothing.
class Checksum {
  public:
    Checksum();
    ~Checksum();
    void add(const void* bytes, std::size_t size);
    std::uint64_t value() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// 128 bits as 32 hexadecimal digits.
std::string checksum_text(std::string_view bytes);

}  // namespace carom
