// Part of the tested page: what the browser complains of, and with ?heard the sound that the
// browser renders, from a loudspeaker that is never late.
'use strict';

var complaints = [];
addEventListener('error', (event) => complaints.push(`${event.message || event.target.src}`), true);
addEventListener('unhandledrejection', (event) => complaints.push(`${event.reason}`));

var heard = null;      // the context of the sound
var scheduled = 0;     // seconds of sound that it has got
if (new URLSearchParams(location.search).has('heard')) {
  window.AudioContext = class extends OfflineAudioContext {
    constructor({sampleRate}) {
      const seconds = 60;
      super(2, seconds * sampleRate, sampleRate);
      heard = this;
    }
    get state() { return 'running'; }
    get currentTime() { return Math.max(0, scheduled - 1 / this.sampleRate); }
    close() { return Promise.resolve(); }
  };
  const start = AudioBufferSourceNode.prototype.start;
  AudioBufferSourceNode.prototype.start = function (when) {
    scheduled = Math.max(scheduled, when + this.buffer.duration);
    return start.call(this, when);
  };
}

// Left and right samples of 16 bits, as the browser renders them.
async function heard_samples() {
  const sound = await heard.startRendering();
  return [0, 1].map((side) => Array.from(sound.getChannelData(side).subarray(0, scheduled * heard.sampleRate),
                                         (level) => Math.round(32768 * level)));
}
