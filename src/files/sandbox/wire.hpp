// Serialises values between two processes of the same program. Each type is described once for both directions:
//     template<class Wire, class T> void exchange(Wire& wire, T& value) { exchangeAll(wire, value.a, value.b); }
// WireOut writes a value; WireIn reads one from untrusted bytes: it checks that flags are 0 or 1 and choices in range,
// and allocates memory as bytes arrive, not as a count claims.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <type_traits>
#include <vector>

namespace cotan {

class WireOut {
public:
    using Send = std::function<bool(std::span<const std::byte>)>; // sends all bytes; false if the receiver is gone

    explicit WireOut(Send send) : send_(std::move(send)) {}

    template<class T> void number(const T& value)
    {
        static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>);
        bytes(std::as_bytes(std::span(&value, 1)));
    }
    void flag(const bool& value) { number(std::uint8_t(value)); }
    template<class E> void choice(const E& value, E) { number(std::uint8_t(value)); }
    template<class Values> void array(const Values& values) // plain values or a text
    {
        static_assert(std::is_trivially_copyable_v<typename Values::value_type>);
        number(std::uint64_t(values.size()));
        bytes(std::as_bytes(std::span(values)));
    }
    template<class T, class F> void list(const std::vector<T>& values, F each)
    {
        number(std::uint64_t(values.size()));
        for (const T& value : values)
            each(*this, value);
    }

    // Sends the buffered bytes. Returns false if not everything was sent.
    bool flush()
    {
        good_ = good_ && (buffer_.empty() || send_(buffer_));
        buffer_.clear();
        return good_;
    }

private:
    static constexpr std::size_t kChunk = 1 << 16; // small values are sent together

    void bytes(std::span<const std::byte> data)
    {
        if (buffer_.size() + data.size() > kChunk)
            flush();
        if (data.size() > kChunk)
            good_ = good_ && send_(data);
        else
            buffer_.insert(buffer_.end(), data.begin(), data.end());
    }

    Send send_;
    std::vector<std::byte> buffer_;
    bool good_ = true;
};

class WireIn {
public:
    using Receive = std::function<std::size_t(std::span<std::byte>)>; // receives some bytes; 0: end of data

    // limit: maximum number of bytes of all values together.
    WireIn(Receive receive, std::uint64_t limit) : receive_(std::move(receive)), remaining_(limit), buffer_(kChunk) {}

    bool good() const { return !ended_ && !invalid_; }
    bool ended() const { return ended_; } // the data ended before the value was complete
    void refuse() { invalid_ = true; }    // marks the data as invalid

    template<class T> void number(T& value)
    {
        static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>);
        bytes(std::as_writable_bytes(std::span(&value, 1)));
    }
    void flag(bool& value)
    {
        std::uint8_t byte = 0;
        number(byte);
        if (byte > 1)
            refuse();
        value = byte == 1;
    }
    template<class E> void choice(E& value, E last)
    {
        std::uint8_t byte = 0;
        number(byte);
        if (byte > std::uint8_t(last))
            refuse();
        else
            value = E(byte);
    }
    template<class Values> void array(Values& values)
    {
        static_assert(std::is_trivially_copyable_v<typename Values::value_type>);
        constexpr std::size_t each = sizeof(typename Values::value_type);
        std::uint64_t count = 0;
        number(count);
        if (count > remaining_ / each)
            refuse();
        values.clear();
        while (good() && values.size() < count) {
            const std::size_t have = values.size();
            const std::size_t step = std::max(kStep / each, have);
            values.resize(have + std::size_t(std::min<std::uint64_t>(step, count - have)));
            bytes(std::as_writable_bytes(std::span(values).subspan(have)));
        }
    }
    template<class T, class F> void list(std::vector<T>& values, F each)
    {
        std::uint64_t count = 0;
        number(count);
        values.clear();
        for (std::uint64_t i = 0; i < count && good(); ++i)
            each(*this, values.emplace_back());
    }

private:
    static constexpr std::size_t kChunk = 1 << 16;
    static constexpr std::size_t kStep = 16 << 20; // bytes that are allocated before any has arrived

    void bytes(std::span<std::byte> data)
    {
        if (data.size() > remaining_)
            refuse();
        if (good())
            remaining_ -= data.size();
        while (!data.empty() && good()) {
            if (next_ == end_ && data.size() >= kChunk) {
                const std::size_t got = receive_(data);
                ended_ = got == 0;
                data = data.subspan(got);
                continue;
            }
            if (next_ == end_) {
                next_ = 0;
                end_ = receive_(buffer_);
                ended_ = end_ == 0;
            }
            const std::size_t part = std::min(data.size(), end_ - next_);
            std::memcpy(data.data(), buffer_.data() + next_, part);
            next_ += part;
            data = data.subspan(part);
        }
    }

    Receive receive_;
    std::uint64_t remaining_;
    std::vector<std::byte> buffer_; // from next_ to end_: received but unused
    std::size_t next_ = 0, end_ = 0;
    bool ended_ = false, invalid_ = false;
};

// Exchanges flags, texts, arrays and numbers in this order, each by its type. Enumerations use choice().
template<class Wire, class... T> void exchangeAll(Wire& wire, T&... values)
{
    const auto one = [&]<class V>(V& value) {
        static_assert(!std::is_enum_v<V>);
        if constexpr (std::is_same_v<std::remove_const_t<V>, bool>)
            wire.flag(value);
        else if constexpr (std::is_trivially_copyable_v<V>)
            wire.number(value);
        else
            wire.array(value);
    };
    (one(values), ...);
}

} // namespace cotan
