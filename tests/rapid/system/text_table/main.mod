! RAPID Instructions, TextTabInstall: texts by number, and those that are not there.
MODULE text_table
  PROC main()
    VAR num t;
    TPWrite ValToStr(TextTabFreeToUse("my_texts")); ! -> TRUE
    TextTabInstall "HOME:/texts.eng";
    TPWrite ValToStr(TextTabFreeToUse("my_texts")); ! -> FALSE
    t:=TextTabGet("my_texts");
    TPWrite TextGet(t,1);                   ! -> one
    TPWrite TextGet(t,99);
    t:=TextTabGet("nobodys");
    TextTabInstall "HOME:/nothing.eng";
    TextTabInstall "HOME:/texts.eng";
    TPWrite "end";                          ! -> end
  ERROR
    TEST ERRNO
    CASE ERR_TXTNOEXIST:
      TPWrite "no text";                    ! -> no text ! -> no text
    CASE ERR_FILEOPEN:
      TPWrite "no file";                    ! -> no file
    DEFAULT:
      TPWrite "other";                      ! -> other
    ENDTEST
    TRYNEXT;
  ENDPROC
ENDMODULE
