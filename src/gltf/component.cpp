#include "gltf/component.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace sweepface::gltf {
namespace {

template <typename T>
T fromLittleEndian(const char* bytes) {
  T value = 0;
  for (std::size_t k = 0; k < sizeof(T); ++k)
    value = static_cast<T>(value | static_cast<T>(static_cast<unsigned char>(bytes[k])) << (8 * k));
  return value;
}

template <typename T>
void appendLittleEndian(std::string& bytes, T value) {
  for (std::size_t k = 0; k < sizeof(T); ++k)
    bytes += static_cast<char>(static_cast<unsigned char>(value >> (8 * k)));
}

template <typename T>
ComponentRange rangeOfType() {
  return {std::numeric_limits<T>::lowest(), std::numeric_limits<T>::max()};
}

}  // namespace

std::optional<Component> componentOf(std::size_t number) {
  switch (number) {
    case 5120:
    case 5121:
    case 5122:
    case 5123:
    case 5125:
    case 5126:
      return static_cast<Component>(number);
    default:
      return std::nullopt;
  }
}

std::size_t sizeOf(Component type) {
  switch (type) {
    case Component::int8:
    case Component::uint8:
      return 1;
    case Component::int16:
    case Component::uint16:
      return 2;
    case Component::uint32:
    case Component::float32:
      return 4;
  }
  return 4;
}

ComponentRange rangeOf(Component type) {
  switch (type) {
    case Component::int8:
      return rangeOfType<std::int8_t>();
    case Component::uint8:
      return rangeOfType<std::uint8_t>();
    case Component::int16:
      return rangeOfType<std::int16_t>();
    case Component::uint16:
      return rangeOfType<std::uint16_t>();
    case Component::uint32:
      return rangeOfType<std::uint32_t>();
    case Component::float32:
      break;
  }
  return rangeOfType<float>();
}

double load(Component type, const char* bytes) {
  switch (type) {
    case Component::int8:
      return static_cast<std::int8_t>(*bytes);
    case Component::uint8:
      return static_cast<std::uint8_t>(*bytes);
    case Component::int16:
      return static_cast<std::int16_t>(fromLittleEndian<std::uint16_t>(bytes));
    case Component::uint16:
      return fromLittleEndian<std::uint16_t>(bytes);
    case Component::uint32:
      return fromLittleEndian<std::uint32_t>(bytes);
    case Component::float32:
      return std::bit_cast<float>(fromLittleEndian<std::uint32_t>(bytes));
  }
  return 0;
}

void append(std::string& bytes, Component type, double value) {
  const auto whole = [&] { return static_cast<std::int64_t>(std::llround(value)); };
  switch (type) {
    case Component::int8:
    case Component::uint8:
      return appendLittleEndian(bytes, static_cast<std::uint8_t>(whole()));
    case Component::int16:
    case Component::uint16:
      return appendLittleEndian(bytes, static_cast<std::uint16_t>(whole()));
    case Component::uint32:
      return appendLittleEndian(bytes, static_cast<std::uint32_t>(whole()));
    case Component::float32:
      return appendLittleEndian(bytes,
                                std::bit_cast<std::uint32_t>(static_cast<float>(value) + 0.0f));
  }
}

}  // namespace sweepface::gltf
