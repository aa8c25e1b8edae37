// Pictures of H.264 that are as the one before, without asking an encoder.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace carom {

/// Writes access units that skip every macroblock: a few bytes each, and no work for whoever
/// decodes them (Rec. ITU-T H.264 (08/2021), 7.3.3 and 7.3.4: P slices of mb_skip_run alone).
///
/// They stand between those of an encoder, whose numbers of frames and places in time they go on
/// with; the encoder must go on with an IDR picture. They have a picture parameter set of their
/// own, since that of the encoder may ask for arithmetic coding. Byte streams (Annex B) throughout.
class H264Still {
  public:
    /// `headers` are the encoder's parameter sets. None where these ask for what is not written
    /// here: fields, scaling lists, a second kind of order.
    static std::optional<H264Still> read(std::span<const std::uint8_t> headers);

    /// The parameter set that the pictures need besides the encoder's.
    const std::string& parameter_set() const { return parameter_set_; }

    /// Takes note of an access unit of the encoder that shows this frame. False where its place in
    /// time is not where it was expected: then no picture may follow.
    bool follow(std::span<const std::uint8_t> unit, std::int64_t frame);

    /// The access unit of this frame, which is as the one before it.
    std::string repeat(std::int64_t frame);

    /// An access unit without supplementary information.
    static std::string pictures_of(std::span<const std::uint8_t> unit);

  private:
    H264Still() = default;

    int frame_num_bits_ = 0;
    int order_bits_ = 0;     ///< of a place in time; 0 where frames are in the order of decoding
    unsigned sequence_ = 0;  ///< number of the sequence parameter set
    unsigned macroblocks_ = 0;
    std::string parameter_set_;
    std::uint32_t next_frame_num_ = 0;
    std::int64_t idr_frame_ = 0;  ///< where places in time begin
};

}  // namespace carom
