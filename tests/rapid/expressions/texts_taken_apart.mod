! RAPID Functions, StrFind, StrMatch and others: places in texts, and texts that are numbers.
MODULE texts_taken_apart
  VAR string word:="Robotics";
  VAR num number;

  PROC main()
    TPWrite ValToStr(StrFind(word,1,"aeiou"))+ValToStr(StrFind(word,1,"aeiou"\NotInSet));    ! -> 21
    TPWrite ValToStr(StrFind(word,1,STR_DIGIT))+ValToStr(StrMatch(word,1,"bo"));             ! -> 93
    TPWrite ValToStr(StrMatch(word,1,"zz"))+ValToStr(StrMemb(word,2,"aeiou"));               ! -> 9TRUE
    TPWrite ValToStr(StrOrder("FIRST","FIRSTB",STR_UPPER));                                  ! -> TRUE
    TPWrite DecToHex("99999999")+" "+HexToDec("5F5E0FF");                                    ! -> 5F5E0FF 99999999
    TPWrite ByteToStr(122\Hex)+" "+ByteToStr(122\Okt)+" "+ByteToStr(122\Bin)+ByteToStr(122\Char);    ! -> 7A 172 01111010z
    TPWrite ValToStr(StrToByte("AE"\Hex))+" "+ValToStr(StrToByte("176"\Okt));                ! -> 174 126
    TPWrite ValToStr(StrToVal("3.85",number))+ValToStr(number);                              ! -> TRUE3.85
    TPWrite ValToStr(StrToVal("abc",number))+ValToStr(number);                               ! -> FALSE3.85
    TPWrite ValToStr(StrDigCmp("1234",LT,"1256"))+StrDigCalc("99999999",OpAdd,"1");          ! -> TRUE100000000
  ENDPROC
ENDMODULE
