#include "fft.hpp"

#include <bit>
#include <numbers>
#include <utility>

namespace cotan::maps {

namespace {

Complex turn(double part) { return std::polar(1.0, 2 * std::numbers::pi * part); }

} // namespace

Fft::Fft(std::size_t size) : size_(size)
{
    const bool plain = std::has_single_bit(size);
    padded_ = plain ? size : std::bit_ceil(2 * size - 1);
    for (std::size_t half = 1; half < padded_; half *= 2)
        for (std::size_t k = 0; k < half; ++k)
            twiddle_.push_back(turn(-double(k) / double(2 * half)));
    if (plain)
        return;
    chirp_.resize(size);
    response_.assign(padded_, 0);
    for (std::size_t n = 0; n < size; ++n) {
        chirp_[n] = turn(-double(n * n % (2 * size)) / double(2 * size));
        response_[n] = std::conj(chirp_[n]);
        if (n > 0)
            response_[padded_ - n] = std::conj(chirp_[n]);
    }
    radix2(response_.data());
}

void Fft::radix2(Complex* x) const
{
    for (std::size_t i = 1, j = 0; i < padded_; ++i) {
        std::size_t bit = padded_ >> 1;
        for (; j & bit; bit >>= 1)
            j ^= bit;
        j ^= bit;
        if (i < j)
            std::swap(x[i], x[j]);
    }
    for (std::size_t half = 1; half < padded_; half *= 2) {
        const Complex* const twiddle = twiddle_.data() + (half - 1);
        for (std::size_t start = 0; start < padded_; start += 2 * half)
            for (std::size_t k = 0; k < half; ++k) {
                const Complex a = x[start + k], b = x[start + k + half], w = twiddle[k];
                // Written out: operator* of std::complex checks for infinities.
                const Complex t(b.real() * w.real() - b.imag() * w.imag(), b.real() * w.imag() + b.imag() * w.real());
                x[start + k] = a + t;
                x[start + k + half] = a - t;
            }
    }
}

void Fft::forward(std::span<Complex> x) const
{
    if (chirp_.empty())
        return radix2(x.data());
    std::vector<Complex> work(padded_, 0);
    for (std::size_t n = 0; n < size_; ++n)
        work[n] = x[n] * chirp_[n];
    radix2(work.data());
    for (std::size_t k = 0; k < padded_; ++k)
        work[k] = std::conj(work[k] * response_[k]); // inverse by conjugates
    radix2(work.data());
    for (std::size_t k = 0; k < size_; ++k)
        x[k] = std::conj(work[k]) * chirp_[k] / double(padded_);
}

void Fft::inverse(std::span<Complex> x) const
{
    for (Complex& c : x)
        c = std::conj(c);
    forward(x);
    for (Complex& c : x)
        c = std::conj(c) / double(size_);
}

void cosineForward(const Fft& fft, std::span<double> x)
{
    const std::size_t n = fft.size();
    std::vector<Complex> v(n);
    for (std::size_t i = 0; i < n; ++i)
        v[i % 2 == 0 ? i / 2 : n - 1 - i / 2] = x[i];
    fft.forward(v);
    for (std::size_t k = 0; k < n; ++k)
        x[k] = 2 * (v[k] * turn(-double(k) / double(4 * n))).real();
}

void cosineInverse(const Fft& fft, std::span<double> x)
{
    const std::size_t n = fft.size();
    std::vector<Complex> v(n);
    for (std::size_t k = 0; k < n; ++k)
        v[k] = 0.5 * turn(double(k) / double(4 * n)) * Complex(x[k], k == 0 ? 0.0 : -x[n - k]);
    fft.inverse(v);
    for (std::size_t i = 0; i < n; ++i)
        x[i] = v[i % 2 == 0 ? i / 2 : n - 1 - i / 2].real();
}

} // namespace cotan::maps
