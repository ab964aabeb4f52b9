"""Prints the pictures of a film as JSON: their number, their times and the end in seconds, and how
many have an opacity. It walks the file by the specification of its format, without a library."""

import json
import struct
import sys
from fractions import Fraction


def gif(data):
    """GIF89a, sections 15 to 27."""

    def palette(flags):
        return 3 << (flags & 7) + 1 if flags & 0x80 else 0

    assert data[:6] == b"GIF89a"
    at, time, delay, times = 13 + palette(data[10]), Fraction(0), Fraction(0), []
    while data[at] != 0x3B:
        if data[at] == 0x21:
            if data[at + 1] == 0xF9:
                delay = Fraction(data[at + 4] + 256 * data[at + 5], 100)
            at += 2
        else:
            assert data[at] == 0x2C, f"byte {at} is no block"
            times.append(time)
            time += delay
            at += 11 + palette(data[at + 9])
        while data[at]:
            at += 1 + data[at]
        at += 1
    assert at + 1 == len(data), f"bytes follow the trailer at {at}"
    return times, time, 0


def boxes(data, begin, end):
    """The boxes of a part of an ISO file: name, begin and end of the content."""
    while begin < end:
        size, name = struct.unpack(">I4s", data[begin : begin + 8])
        head = 8
        if size == 1:
            size, head = struct.unpack(">Q", data[begin + 8 : begin + 16])[0], 16
        yield name.decode("latin-1"), begin + head, begin + (size or end - begin)
        begin += size or end - begin


def inner(data, part, path):
    """The contents of all boxes with this path, such as mdia/minf."""
    found = [part]
    for name in path.split("/"):
        found = [(b, e) for place in found for n, b, e in boxes(data, *place) if n == name]
    return found


def numbers(data, at, count, form):
    return struct.unpack_from(f">{count}{form}", data, at)


def iso(data):
    """The samples of the video track of an mp4 or mov (ISO 14496-12: stts, ctts, stsz, elst)."""
    for track in inner(data, (0, len(data)), "moov/trak"):
        ((handler, _),) = inner(data, track, "mdia/hdlr")
        if data[handler + 8 : handler + 12] != b"vide":
            continue
        ((header, _),) = inner(data, track, "mdia/mdhd")
        (scale,) = numbers(data, header + (20 if data[header] else 12), 1, "I")
        durations, shifts = [], []
        ((stts, _),) = inner(data, track, "mdia/minf/stbl/stts")
        for k in range(numbers(data, stts + 4, 1, "I")[0]):
            count, duration = numbers(data, stts + 8 + 8 * k, 2, "I")
            durations += count * [duration]
        for ctts, _ in inner(data, track, "mdia/minf/stbl/ctts"):
            for k in range(numbers(data, ctts + 4, 1, "I")[0]):
                (count,) = numbers(data, ctts + 8 + 8 * k, 1, "I")
                shifts += count * list(numbers(data, ctts + 12 + 8 * k, 1, "i"))
        ((stsz, _),) = inner(data, track, "mdia/minf/stbl/stsz")
        assert numbers(data, stsz + 8, 1, "I")[0] == len(durations)
        start = 0
        for elst, _ in inner(data, track, "edts/elst"):
            assert numbers(data, elst + 4, 1, "I")[0] == 1, "more than one edit"
            at, form = (elst + 16, "q") if data[elst] else (elst + 12, "i")
            (start,) = numbers(data, at, 1, form)
        times, time = [], 0
        for duration, shift in zip(durations, shifts or len(durations) * [0]):
            times.append(Fraction(time + shift - start, scale))
            time += duration
        return sorted(times), Fraction(time, scale), 0
    raise AssertionError("no video track")


def vint(data, at, keep_marker):
    """A number of EBML (RFC 8794, section 4), and the place after it."""
    length = 9 - data[at].bit_length()
    value = int.from_bytes(data[at : at + length], "big")
    unknown = value == (1 << 7 * length + 1) - 1
    if not keep_marker:
        value &= (1 << 7 * length) - 1
    return (None if unknown else value), at + length


def elements(data, begin, end):
    while begin < end:
        name, at = vint(data, begin, True)
        size, at = vint(data, at, False)
        stop = end if size is None else at + size
        yield name, at, stop
        begin = stop


SEGMENT, CLUSTER, TIMECODE = 0x18538067, 0x1F43B675, 0xE7
INFO, SCALE, LENGTH = 0x1549A966, 0x2AD7B1, 0x4489
SIMPLE, GROUP, BLOCK, ADDITIONS = 0xA3, 0xA0, 0xA1, 0x75A1


def parts(data, begin, end, wanted):
    """Begin and end of the elements of this name."""
    return [(at, stop) for name, at, stop in elements(data, begin, end) if name == wanted]


def whole_number(data, place):
    return int.from_bytes(data[slice(*place)], "big")


def matroska(data):
    """The blocks of track 1 (RFC 9559). The opacity of a picture is an addition to its block."""
    ((begin, end),) = parts(data, 0, len(data), SEGMENT)
    ((info, info_end),) = parts(data, begin, end, INFO)
    scale = Fraction(whole_number(data, parts(data, info, info_end, SCALE)[0]), 10**9)
    ((length, length_end),) = parts(data, info, info_end, LENGTH)
    (length,) = struct.unpack(">d" if length_end - length == 8 else ">f", data[length:length_end])
    times, opacities = [], 0
    for begin, end in parts(data, begin, end, CLUSTER):
        base = whole_number(data, parts(data, begin, end, TIMECODE)[0])
        blocks = [at for at, _ in parts(data, begin, end, SIMPLE)]
        for group in parts(data, begin, end, GROUP):
            blocks += [at for at, _ in parts(data, *group, BLOCK)]
            opacities += len(parts(data, *group, ADDITIONS))
        for block in blocks:
            track, at = vint(data, block, False)
            if track == 1:
                times.append((base + struct.unpack(">h", data[at : at + 2])[0]) * scale)
    return sorted(times), Fraction(length) * scale, opacities


data = open(sys.argv[1], "rb").read()
read = gif if data[:3] == b"GIF" else matroska if data[:4] == b"\x1a\x45\xdf\xa3" else iso
times, end, opacities = read(data)
result = {"pictures": len(times), "times": [float(time) for time in times], "end": float(end)}
print(json.dumps(result | {"opacities": opacities}))
