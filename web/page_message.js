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
