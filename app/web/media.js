// Films and sound of the page, by the encoders and the loudspeakers of the browser.
'use strict';

// A film of the part of the canvas with the gas.
class Film {
  constructor(width, height) {
    const longest = 1920, even = (length) => 2 * Math.round(length / 2);
    const scale = Math.min(1, longest / Math.max(width, height));
    this.sheet = document.createElement('canvas');
    this.sheet.width = even(scale * width);
    this.sheet.height = even(scale * height);
    this.pen = this.sheet.getContext('2d', {alpha: false});
    const stream = this.sheet.captureStream(0);  // takes a frame when asked
    // Firefox asks the stream, other browsers its track.
    this.source = stream.requestFrame ? stream : stream.getVideoTracks()[0];
    this.pieces = [];
    this.record(stream);
  }

  // Browsers may lack the encoder of a type that they say to support.
  record(stream) {
    const types = ['video/mp4;codecs=avc1.64002A', 'video/webm;codecs=vp9', 'video/webm', 'video/mp4'];
    const bits_per_pixel_and_second = 6;
    let reason = 'it has no encoder';
    for (const type of types.filter((type) => MediaRecorder.isTypeSupported(type))) {
      try {
        const recorder = new MediaRecorder(stream, {
          mimeType: type,
          videoBitsPerSecond: bits_per_pixel_and_second * this.sheet.width * this.sheet.height});
        recorder.ondataavailable = (event) => { this.pieces.push(event.data); };
        recorder.onerror = (event) => { this.failure = event.error || 'its encoder failed'; };
        this.stopped = new Promise((done) => { recorder.onstop = done; });
        this.stopped.then(wake);
        recorder.start();
        this.recorder = recorder;
        this.extension = '.' + type.split(/[/;]/)[1];
        return;
      } catch (error) {
        reason = error;
      }
    }
    throw reason;
  }

  add(x, y, width, height) {
    if (this.recorder.state === 'inactive') this.failure ||= 'its encoder has stopped';
    if (this.failure) throw this.failure;
    const {sheet, pen} = this;
    const scale = Math.min(sheet.width / width, sheet.height / height);
    const [wide, tall] = [scale * width, scale * height];
    pen.clearRect(0, 0, sheet.width, sheet.height);
    pen.drawImage(canvas, x, y, width, height, (sheet.width - wide) / 2, (sheet.height - tall) / 2,
                  wide, tall);
    this.source.requestFrame();
  }

  // Resolves to the pieces of the file.
  async end() {
    if (this.recorder.state !== 'inactive') this.recorder.stop();
    await this.stopped;
    if (!this.pieces.some((piece) => piece.size)) throw 'it has recorded no picture';
    return this.pieces;
  }
}

// Plays samples one after the other.
class Speaker {
  constructor(rate) {
    this.rate = rate;  // samples per second
    this.context = new AudioContext({sampleRate: rate});
    this.end = 0;      // time of the context at which the last sample ends, in samples
    const patience = 2000;  // milliseconds
    this.doubt = setTimeout(() => {
      if (!this.plays()) tell('The browser plays no sound. Click the page once more, or check its settings.');
    }, patience);
  }

  close() {
    clearTimeout(this.doubt);
    return this.context.close();
  }

  plays() {
    return this.context.state === 'running';
  }

  // Browsers are silent until the user has pressed a key or a button.
  resume() {
    if (!this.plays()) this.context.resume().catch(() => {});
  }

  now() {
    return Math.ceil(this.context.currentTime * this.rate);
  }

  // Number of samples that were not played yet.
  waiting() {
    return Math.max(0, this.end - this.now());
  }

  // Left and right alternate. A context that stands still would keep them for later.
  play(samples) {
    if (!this.plays()) return;
    const length = samples.length / 2;
    const buffer = this.context.createBuffer(2, length, this.rate);
    for (const side of [0, 1]) {
      const channel = buffer.getChannelData(side);
      for (let k = 0; k < length; ++k) channel[k] = samples[2 * k + side] / 32768;
    }
    const source = this.context.createBufferSource();
    source.buffer = buffer;
    source.connect(this.context.destination);
    const begin = Math.max(this.end, this.now());
    source.start(begin / this.rate);
    this.end = begin + length;
  }
}
