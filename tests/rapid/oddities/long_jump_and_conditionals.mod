! Field practice, Libraries: wrappers pass options on and catch everything.
MODULE long_jump_and_conditionals
  PROC main()
    guarded\fast;
    guarded;
  ENDPROC

  PROC guarded(\switch fast|switch slow)
    work\fast?fast\slow?slow;
  ERROR (LONG_JMP_ALL_ERR)
    TPWrite "caught "\Num:=ERRNO;         ! -> caught 3
    TRYNEXT;
  ENDPROC

  PROC work(\switch fast|switch slow)
    IF Present(fast) RAISE 3;
    TPWrite "no hurry";                   ! -> no hurry
  ENDPROC
ENDMODULE
