'use strict';
// Loads the page anew when the scene has been saved, and goes on at the same instant.
(() => {
  const revision = document.getElementById('revision').dataset.number, note = document.getElementById('lost');
  const ready = setInterval(() => {
    if (!window.carom || !window.carom.viewer) return;
    clearInterval(ready);
    const kept = JSON.parse(sessionStorage.getItem('carom') || '{}'), {viewer} = window.carom;
    if (kept.place) {
      viewer.eye.orbit(0, 0);
      viewer.eye.camera.position.fromArray(kept.place);
      viewer.eye.target.fromArray(kept.target);
      viewer.eye.aim();
    }
    if (kept.t) viewer.show(kept.t);
  }, 50);
  const keep = () => {
    if (!window.carom || !window.carom.viewer) return;
    const {t, eye} = window.carom.viewer, kept = {t};
    if (eye.free) Object.assign(kept, {place: eye.camera.position.toArray(), target: eye.target.toArray()});
    sessionStorage.setItem('carom', JSON.stringify(kept));
  };
  const ask = async () => {
    try {
      const answer = await fetch('/revision', {cache: 'no-store'});
      note.hidden = answer.ok;
      if (answer.ok && (await answer.text()) !== revision) {
        keep();
        location.reload();
        return;
      }
    } catch (error) {
      note.hidden = false;
    }
    setTimeout(ask, 300);
  };
  ask();
})();
