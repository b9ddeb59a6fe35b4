import assert from 'node:assert/strict';

/** Whether the updates of a mesh, at rest at first, say when there is something to draw; disposes of it. */
export function assertTellsWhetherToDraw(mesh) {
  assert.equal(mesh.update(), false);
  mesh.setWeights({jawOpen: 1});
  assert.deepEqual([mesh.update(), mesh.update()], [true, false]);
  mesh.moveTo({jawOpen: 0}, {kind: 'linear-force', seconds: 0.1});
  assert.deepEqual([0.05, 0, 0.06, 0.01, 0.01].map((seconds) => mesh.update(seconds)), [true, true, true, true, false]);
  mesh.dispose();
  assert.equal(mesh.update(), false);
}
