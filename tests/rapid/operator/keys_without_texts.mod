! RAPID Instructions, TPReadFK: a question without any key cannot be answered.
MODULE keys_without_texts
  VAR num key;

  PROC main()
    TPReadFK key,"Which?",stEmpty,stEmpty,stEmpty,stEmpty,stEmpty;    ! stops: TPReadFK has no text for any key, so no answer is possible
  ENDPROC
ENDMODULE
