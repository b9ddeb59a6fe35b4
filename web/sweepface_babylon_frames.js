// What happens each frame of a Babylon.js scene.

/** The seconds that pass with a step of Babylon.js's own animations, `milliseconds` after the last one. */
function passing(scene, milliseconds) {
  const engine = scene.getEngine();
  if (!scene.animationsEnabled) return 0;
  if (engine.isDeterministicLockStep()) return engine.getTimeStep() / 1000;
  if (scene.useConstantAnimationDeltaTime) return 0.016;  // whatever the scale of time
  return milliseconds * scene.animationTimeScale / 1000;
}

/**
 * Calls `pass` with the seconds that pass after the scene's own animations, and `show` after all that may set weights
 * before the frame. Returns a function that ends this.
 */
export function eachFrame({onAfterAnimationsObservable, onBeforeRenderTargetsRenderObservable}, pass, show) {
  let before;
  const passes = onAfterAnimationsObservable.add((scene) => {  // not called if a frame ignores animations
    const now = performance.now();
    pass(passing(scene, now - (before ?? now)));
    before = now;
  });
  const shows = onBeforeRenderTargetsRenderObservable.add(show);
  return () => {
    onAfterAnimationsObservable.remove(passes);
    onBeforeRenderTargetsRenderObservable.remove(shows);
  };
}
