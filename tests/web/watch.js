// Part of the tested page: what the browser complains of, and with ?heard the sound that the browser
// renders.
'use strict';

var complaints = [];
addEventListener('error', (event) => complaints.push(`${event.message || event.target.src}`), true);
addEventListener('unhandledrejection', (event) => complaints.push(`${event.reason}`));
addEventListener('securitypolicyviolation',
                 (event) => complaints.push(`${event.violatedDirective} forbids ${event.blockedURI}`));

var heard = null;   // the context of the sound
var scheduled = 0;  // seconds of sound that it has got
if (new URLSearchParams(location.search).has('heard')) {
  // The clock of the page and of the sound advances by 1/30 s per picture, so no picture is late.
  const ask = window.requestAnimationFrame;
  let shown = 0, last = 0;
  window.requestAnimationFrame = (draw) => ask((time) => {
    if (time !== last) ++shown;
    last = time;
    draw(time);
  });
  performance.now = () => 1000 * shown / 30;
  window.AudioContext = class extends OfflineAudioContext {
    constructor({sampleRate}) {
      const seconds = 60;
      super(2, seconds * sampleRate, sampleRate);
      heard = this;
      this.opened = performance.now();
    }
    get state() { return 'running'; }
    get currentTime() { return (performance.now() - this.opened) / 1000; }
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
