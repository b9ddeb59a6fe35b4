// What the page says where there is no face to show.
export const at = (id) => document.getElementById(id);

const message = at('message');

export function say(text, className = '') {
  message.textContent = text;
  message.className = className;
}

export function complain(error) {
  say(error.message, 'error');
}

const isError = () => message.className === 'error';

/** Takes an error away, and nothing else. */
export function dismiss() {
  if (isError()) say('');
}

/** Takes anything away but an error. */
export function hush() {
  if (!isError()) say('');
}
